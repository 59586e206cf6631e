#include "FuzzTarget.h"
#include "lamp/core/Csv.h"

using namespace lamp;

/** What was read as a table is the same table when it is written and read again. */
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::mayRefuse("fuzz.csv", [&] {
    const CsvTable table = CsvTable::fromText(fuzz::textOf(data, size), "fuzz.csv");
    const CsvTable again = CsvTable::fromText(table.text(), "again.csv");
    fuzz::require(table.columns == again.columns && table.rows == again.rows, "CSV round trip");
  });
  return 0;
}
