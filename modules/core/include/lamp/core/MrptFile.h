#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <functional>
#include <string>

namespace lamp {

/** Takes the objects of a file in their order. */
using MrptSink = std::function<void(const mrpt::serialization::CSerializable&)>;

/** Writes a gzipped file of MRPT objects, such as a rawlog, with writeAtomically(), object by
 * object, so that a recording need never be whole in memory. Equal objects give equal bytes.
 * \throws std::runtime_error naming the path, also when the disk is full; what `write` throws goes
 * through. */
void writeMrptFile(const std::string& path, const std::function<void(const MrptSink&)>& write);

}  // namespace lamp
