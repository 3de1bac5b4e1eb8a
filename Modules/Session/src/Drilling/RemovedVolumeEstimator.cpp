#include "petrous/Session/RemovedVolumeEstimator.h"

#include <algorithm>
#include <memory>

namespace petrous::session
{

const dissection::RemovedVolume& RemovedVolumeEstimator::soFar(const dissection::Dissection& work,
                                                               const Measure& measure)
{
  if (!work.strokeOpen() || work.changes() != m_stroke)
    m_removed = {};
  m_stroke = work.changes();
  const auto now = Clock::now();
  if (m_result.valid() && m_result.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
  {
    Result result = m_result.get();
    if (work.strokeOpen() && m_pending == m_stroke)
      m_removed = std::move(result.removed);
    const double pause = std::max(kEvery, kMaxShare * result.seconds) - result.seconds;
    m_next = now + std::chrono::duration_cast<Clock::duration>(
                       std::chrono::duration<double>(std::max(0.0, pause)));
  }
  if (!work.strokeOpen() || m_result.valid() || now < m_next)
    return m_removed;
  m_pending = m_stroke;
  m_result = std::async(std::launch::async,
                        [copy = std::make_unique<dissection::Dissection>(work), measure]
                        {
                          const auto start = Clock::now();
                          Result result;
                          result.removed = measure(*copy);
                          result.seconds =
                              std::chrono::duration<double>(Clock::now() - start).count();
                          return result;
                        });
  return m_removed;
}

} // namespace petrous::session
