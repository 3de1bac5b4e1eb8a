#pragma once

#include <filesystem>

#include "petrous/Core/BenchmarkReport.h"
#include "petrous/Core/Progress.h"

namespace petrous::network
{

/// Transfer of a CT series of 512 slices of 512^2 (quick: 24 of 128^2) to and from an Orthanc on
/// the loopback, with TLS and without, and with Nagle's algorithm off and on in what DCMTK opens
/// (the server, and the peers; this program always switches it off). Medians of 3 (quick, and with
/// Nagle's algorithm: 1), each with an empty server.
///
/// Error: the percentage of the instances that did not arrive, or whose pixel data differ from what
/// was written. Extra: `mb_per_s` of file size, 1e6 bytes.
///
/// The peers are DCMTK's: storescu, and a C-GET of its class DcmTLSSCU as it comes.
///
/// workFolder  temporary location of the files (1.1 GB)
/// Without Orthanc the report has no points, and says so in `machine`.
core::BenchmarkReport runNodeBenchmark(const std::filesystem::path& workFolder, bool quick,
                                       const core::Progress& progress);

} // namespace petrous::network
