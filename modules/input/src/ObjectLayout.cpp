#include "ObjectLayout.h"

#include "LayoutCursor.h"
#include "RewindableStream.h"

namespace lamp {

ObjectLayout layoutOf(RewindableStream& stream) {
  LayoutCursor cursor(stream);
  cursor.recorded();
  return {stream.position(), cursor.pictures()};
}

}  // namespace lamp
