#include "InstrumentDistance.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "petrous/Volume/MeshInside.h"
#include "petrous/Volume/MeshTree.h"

namespace petrous::rendering
{

namespace
{
constexpr const char* kTask = "measuring the instrument";
}

InstrumentDistance InstrumentDistance::of(const core::TriangleMesh& instrument,
                                          const core::Progress& progress)
{
  InstrumentDistance result;
  if (instrument.triangles.empty())
    return result;
  const volume::MeshInside inside(instrument);
  progress.check(kTask);
  const volume::MeshTree tree(instrument);
  const auto [first, last] = instrument.bounds();
  result.lower = first.cast<double>().array() - kMargin;
  Eigen::Vector3d upper = last.cast<double>().array() + kMargin;
  upper.z() = std::min(upper.z(), kPart);
  const Eigen::Vector3d size = upper - result.lower;
  if (!(size.minCoeff() > 0.0))
    return result;
  result.edge = std::max(kFinest, std::cbrt(size.prod() / kMostSamples));
  std::size_t count = 1;
  for (std::size_t a = 0; a < 3; ++a)
  {
    result.dims[a] =
        static_cast<int>(std::ceil(size[static_cast<Eigen::Index>(a)] / result.edge)) + 1;
    count *= static_cast<std::size_t>(result.dims[a]);
  }
  result.distances.resize(count);
  const bool isClosed = inside.openEdges() == 0;
  const auto width = static_cast<std::size_t>(result.dims[0]);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count / width),
      [&](const tbb::blocked_range<std::size_t>& rows)
      {
        std::vector<double> crossings;
        for (std::size_t row = rows.begin(); row < rows.end(); ++row)
        {
          progress.check(kTask);
          const auto rowsOfLayer = static_cast<std::size_t>(result.dims[1]);
          const auto j = static_cast<double>(row % rowsOfLayer);
          const auto k = static_cast<double>(row / rowsOfLayer);
          Eigen::Vector3d at = result.lower + result.edge * Eigen::Vector3d(0.0, j, k);
          if (isClosed)
            inside.crossings(at.y(), at.z(), crossings);
          for (std::size_t i = 0; i < width; ++i)
          {
            at.x() = result.lower.x() + result.edge * static_cast<double>(i);
            const auto passed = std::lower_bound(crossings.begin(), crossings.end(), at.x());
            const bool isIn = (passed - crossings.begin()) % 2 == 1;
            const double distance = tree.distance(at, std::numeric_limits<double>::infinity());
            result.distances[row * width + i] = static_cast<float>(isIn ? -distance : distance);
          }
        }
      });
  return result;
}

InstrumentMeasurement::InstrumentMeasurement(std::shared_ptr<const core::TriangleMesh> instrument)
  : m_instrument(std::move(instrument))
  , m_result(std::async(std::launch::async,
                        [mesh = m_instrument, progress = core::Progress(nullptr, m_token)]
                        { return InstrumentDistance::of(*mesh, progress); }))
{
}

InstrumentMeasurement::~InstrumentMeasurement()
{
  m_token->cancel(); // the future of std::async waits
}

bool InstrumentMeasurement::isDone() const
{
  return m_result.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

} // namespace petrous::rendering
