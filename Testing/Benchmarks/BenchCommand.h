#pragma once

#include "Context.h"

namespace petrous::cli
{

void addBenchCommand(CLI::App& app, cli::Context& context);

} // namespace petrous::cli
