#include "ToolDistances.h"

namespace petrous::workstation
{

namespace
{
constexpr int kAgain = 60;    // ms; faster than anyone can read
constexpr int kLong = 4;      // ms, of a frame
constexpr int kLongAgain = 4; // frames: an instrument among many structures takes longer, but what
                              // is warned of is measured in each of them
} // namespace

ToolDistances::ToolDistances(presenters::WorkstationModel& model, QObject* parent)
  : QObject(parent)
  , m_model(model)
{
}

void ToolDistances::toolMoved(const presenters::MeasuredTool& tool, const haptics::Pose& pose)
{
  if (m_sinceAsked.isValid() && m_sinceAsked.elapsed() < kAgain)
    return;
  m_sinceAsked.start();
  const bool isDue =
      m_wideTook <= kLong || !m_sinceWide.isValid() || m_sinceWide.elapsed() >= kLongAgain * kAgain;
  const bool isWide = isDue && isWideWanted();
  if (isWide)
    m_sinceWide.start();
  const presenters::ToolSurroundings near = m_model.surroundings(tool, pose, isWide);
  if (isWide)
    m_wideTook = m_sinceWide.elapsed();
  emit measured(near);
}

void ToolDistances::toolGone()
{
  m_sinceAsked.invalidate();
  m_sinceWide.invalidate();
}

} // namespace petrous::workstation
