#pragma once

#include <mrpt/serialization/CSerializable.h>

namespace lamp {

class RewindableStream;

/** Reads the object at the stream's position with MRPT, after its layout has been checked. Pictures
 * in it are empty: nobody uses them, and MRPT ends the program where it cannot decode one.
 *  \throws UnreadClass; std::exception if the object is damaged. */
mrpt::serialization::CSerializable::Ptr readCheckedObject(RewindableStream& stream);

}  // namespace lamp
