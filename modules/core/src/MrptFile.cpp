#include "lamp/core/MrptFile.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>

#include "GzFile.h"
#include "lamp/core/Files.h"

namespace lamp {

void writeMrptFile(const std::string& path, const std::function<void(const MrptSink&)>& write) {
  writeAtomically(path, [&](const std::string& temporary) {
    GzFile file(temporary, path);
    write([&](const mrpt::serialization::CSerializable& object) {
      mrpt::io::CMemoryStream memory;
      mrpt::serialization::archiveFrom(memory) << object;
      file.write(memory.getRawBufferData(), memory.getTotalBytesCount());
    });
    file.close();
  });
}

}  // namespace lamp
