#pragma once

#include <string>
#include <utility>
#include <vector>

#include "wheatstone/study/analysis.h"
#include "wheatstone/study/published.h"

namespace wheatstone {

/// Tables of an analysis, tab-separated, by the names of their files: means, effects, comparisons, head movement and
/// questions, and published means where there are some. Each row says whether observers were simulated.
std::vector<std::pair<std::string, std::string>> analysis_tables(
    const StudyData& data, const StudyAnalysis& analysis, const std::vector<PublishedComparison>& published = {});

/// The analysis as a page (HTML) with its figures (SVG) in it.
std::string analysis_page(const StudyData& data, const StudyAnalysis& analysis,
                          const std::vector<PublishedComparison>& published = {});

}  // namespace wheatstone
