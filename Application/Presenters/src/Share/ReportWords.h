#pragma once

#include <string>

#include "petrous/Presenters/PlanReport.h"

namespace petrous::presenters
{

/// A text of the report in its language: by the report's own words, else as a phrase of the program.
/// What is neither stays as it is.
std::string reportText(ReportLanguage language, const std::string& english);

} // namespace petrous::presenters
