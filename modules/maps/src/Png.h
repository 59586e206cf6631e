#pragma once

#include <mrpt/img/CImage.h>

#include <string>

namespace lamp {

/** \param image in colour. \throws std::runtime_error naming the path. */
void writePng(const mrpt::img::CImage& image, const std::string& path);

}  // namespace lamp
