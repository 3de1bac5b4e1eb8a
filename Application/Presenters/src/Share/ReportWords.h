#pragma once

#include <string>

#include "petrous/Presenters/PlanReport.h"

namespace petrous::presenters
{

/// A text of the report in its language. Texts without a translation stay English.
std::string reportText(ReportLanguage language, const std::string& english);

} // namespace petrous::presenters
