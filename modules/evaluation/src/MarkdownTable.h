#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace lamp::evaluation {

/** The report (see reportJson()) as Markdown: one table, one column a run, and the notes. */
std::string markdownReport(const nlohmann::ordered_json& report);

}  // namespace lamp::evaluation
