#pragma once

#include <string>

#include "petrous/Presenters/PlanReport.h"

namespace petrous::presenters
{

/// A text of the report in its language: by the report's own words, else as a phrase of the
/// program. What is neither stays as it is. Its decimal numbers are written as the language does.
std::string reportText(ReportLanguage language, const std::string& english);

/// A number, or a text of numbers and units alone, as the language writes them: "0,25 mm".
std::string reportNumber(ReportLanguage language, std::string text);

/// A date of ISO 8601 as the language writes it: "27.11.2026". What is no date stays as it is.
std::string reportDate(ReportLanguage language, const std::string& date);

} // namespace petrous::presenters
