#pragma once

#include <string>

#include "petrous/Core/Progress.h"
#include "petrous/Presenters/PlanReport.h"

namespace petrous::report
{

/// The report as a PDF of A4 pages; pictures without loss. Its metadata say "Operation plan",
/// "Petrous" and when it was made, nothing else.
///
/// On any thread of a program that has a QGuiApplication; without one, on the main thread, which
/// then gets one without a display for the time of the call. Throws core::Error where there is no
/// font, CancelledError.
std::string pdfOf(const presenters::PlanReport& report, const core::Progress& progress = {});

} // namespace petrous::report
