#include "petrous/Session/SessionRecorder.h"

#include <utility>

namespace petrous::session
{

SessionRecorder::SessionRecorder(const std::filesystem::path& file, const RecordingSetup& setup)
  : m_writer(file, setup)
{
}

template <typename Work>
void SessionRecorder::attempt(Work work)
{
  if (!m_on)
    return;
  try
  {
    work();
  }
  catch (const std::exception& error)
  {
    m_on = false;
    m_failure = std::string("The recording ended: ") + error.what() + ".";
  }
}

void SessionRecorder::add(const TickRecord* records, std::size_t count)
{
  attempt(
      [&]
      {
        for (std::size_t n = 0; n < count; ++n)
        {
          if (records[n].number != m_next)
          {
            m_writer.close();
            m_on = false;
            m_failure = "The recording ended: the program stood still for longer than it can "
                        "bridge. It holds the session up to there.";
            return;
          }
          m_writer.add(records[n]);
          ++m_next;
        }
      });
}

void SessionRecorder::add(const MaskEdit& edit)
{
  attempt([&] { m_writer.add(edit); });
}

void SessionRecorder::close()
{
  attempt([this] { m_writer.close(); });
  m_on = false;
}

std::string SessionRecorder::takeFailure()
{
  return std::exchange(m_failure, {});
}

} // namespace petrous::session
