#pragma once
// A study as one self-contained HTML page: what was asked, what came out, figures, failures, and how to see
// one evaluation again. Made from the folder alone (plan.json, result.json, results.h5); the figures are
// drawn by gnuplot and are part of the page, which needs no network.

#include "strainwave/studies/file/study.hpp"

#include <filesystem>
#include <string>

namespace strainwave {

/// Writes DIR/report.html and DIR/figures/. Returns a sentence where figures are missing (no gnuplot); empty:
/// all there. Throws FileError without a plan, std::system_error without results or where nothing can be
/// written.
std::string write_report(const std::filesystem::path& folder, StudyKinds kinds);

} // namespace strainwave
