#pragma once

#include <mrpt/serialization/CSerializable.h>

#include <functional>
#include <string>

namespace lamp {

/** Takes the objects of a rawlog in their order. */
using RawlogSink = std::function<void(const mrpt::serialization::CSerializable&)>;

/** Writes a gzipped MRPT rawlog with writeAtomically(), object by object, so that a recording need
 * never be whole in memory. Equal objects give equal bytes. \throws std::runtime_error naming the
 * path, also when the disk is full; what `write` throws goes through. */
void writeRawlog(const std::string& path, const std::function<void(const RawlogSink&)>& write);

}  // namespace lamp
