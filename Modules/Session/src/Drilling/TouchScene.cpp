#include "petrous/Session/TouchScene.h"

#include <utility>

#include "petrous/Haptics/ConstrainedProxy.h"
#include "petrous/Haptics/PointProxy.h"
#include "petrous/Haptics/PointShell.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Session/ConstantThrust.h"

namespace petrous::session
{

haptics::ProxyParameters couplingFor(TouchTool::Mode mode, std::optional<double> thrust) noexcept
{
  // In three degrees of freedom the centre sinks in by thrust over stiffness, a measure of the
  // force.
  if (!thrust || mode == TouchTool::Mode::ThreeDof)
    return {};
  return ConstantThrust::coupling(*thrust);
}

FeltTissue feltTissue(const scene::Case& value, const volume::TissueField& whole,
                      const core::Progress& progress, std::uint64_t firstState)
{
  progress.check("feeling the tissue");
  FeltTissue felt;
  felt.mask = std::make_shared<volume::PublishedMask>(value.dissection.mask(), firstState);
  scene::TouchTissue tissue = scene::touchTissue(value, whole, progress);
  std::vector<haptics::SoftStructure> soft;
  for (scene::SoftSolid& solid : tissue.soft)
    soft.push_back({std::move(solid.depth), solid.stiffness});
  felt.field = std::make_shared<const haptics::HapticField>(
      tissue.rigid, felt.mask, std::move(soft),
      haptics::KeptField{tissue.key ? value.derived : nullptr, tissue.key.value_or("")});
  return felt;
}

std::shared_ptr<const haptics::PointShell> shellOf(const dissection::Burr& burr,
                                                   const core::GridGeometry& geometry)
{
  haptics::BurrShape shape;
  shape.radius = 0.5 * burr.diameter;
  return std::make_shared<const haptics::PointShell>(
      haptics::makeBurrShell(shape, geometry.minSpacing()));
}

TouchScene::TouchScene(scene::Case& value, const core::Progress& progress, std::uint64_t firstState,
                       bool regional)
  : TouchScene(value, DrillSession(value, {}, regional), progress, firstState)
{
}

TouchScene::TouchScene(scene::Case& value, const DrillSession& drill,
                       const core::Progress& progress, std::uint64_t firstState)
  : TouchScene(value, drill, feltTissue(value, drill.field(), progress, firstState))
{
}

TouchScene::TouchScene(scene::Case& value, const DrillSession& drill, FeltTissue felt)
  : m_case(value)
  , m_drill(value, drill)
  , m_mask(std::move(felt.mask))
  , m_field(std::move(felt.field))
{
  const volume::CutMask& mask = value.dissection.mask();
  if (!sameGrid(m_mask->geometry(), mask.geometry()))
    throw core::InvalidParameter("touch: the tissue is of another case");
  std::vector<std::size_t> changed;
  for (std::size_t n = 0; n < mask.brickCount(); ++n)
    if (m_mask->brick(n) != mask.brick(n))
      changed.push_back(n);
  if (!changed.empty())
    publish(changed);
}

std::shared_ptr<const core::LockedMemory> TouchScene::lockedMemory() const
{
  std::shared_ptr<const core::LockedMemory> locked = m_locked.lock();
  if (!locked)
  {
    locked = std::make_shared<const core::LockedMemory>(m_field->memory());
    m_locked = locked;
  }
  return locked;
}

void TouchScene::publish(const std::vector<std::size_t>& bricks)
{
  m_mask->publish(m_case.dissection.mask(), bricks, true);
}

const haptics::PointShell& TouchScene::shellOf(const TouchTool& tool) const
{
  if (tool.instrument)
    return *tool.instrument->shell;
  auto& known = m_shells[tool.burr.diameter];
  if (!known)
    known = session::shellOf(tool.burr, m_field->geometry());
  return *known;
}

void TouchScene::giveShell(const dissection::Burr& burr,
                           std::shared_ptr<const haptics::PointShell> shell)
{
  m_shells[burr.diameter] = std::move(shell);
}

std::unique_ptr<haptics::Proxy> TouchScene::proxyOf(const TouchTool& tool) const
{
  if (tool.mode == TouchTool::Mode::ThreeDof && !tool.instrument)
  {
    haptics::CentreBurr burr;
    burr.radius = 0.5 * tool.burr.diameter;
    return std::make_unique<haptics::PointProxy>(m_field, burr, tool.coupling);
  }
  return std::make_unique<haptics::ConstrainedProxy>(m_field, shellOf(tool), tool.coupling);
}

ServoSetup TouchScene::servoOf(const TouchTool& tool) const
{
  ServoSetup setup;
  setup.stiffness = tool.coupling.stiffness;
  const bool isCentre = tool.mode == TouchTool::Mode::ThreeDof && !tool.instrument;
  setup.burrPoints = isCentre ? 1 : shellOf(tool).burrCount;
  return setup;
}

RecordingSetup TouchScene::recordingOf(const TouchTool& tool, const ServoSetup& servo,
                                       const std::string& note) const
{
  if (tool.instrument)
    throw core::InvalidParameter("recording: " + tool.instrument->name +
                                 " is an instrument, whose surface a recording does not hold; "
                                 "record a burr");
  RecordingSetup setup;
  setup.note = note;
  setup.burr = tool.burr;
  setup.degrees = tool.mode == TouchTool::Mode::ThreeDof ? 3 : 6;
  setup.tool = toString(setup);
  setup.proxy = tool.coupling;
  setup.servo = servo;
  setup.scene = fingerprint();
  return setup;
}

std::unique_ptr<CaseRemoval> TouchScene::removalOf(const dissection::Burr& burr,
                                                   const dissection::Catalogues& catalogues) const
{
  return std::make_unique<CaseRemoval>(m_case, m_drill.field(), m_drill.protectedTissue(), burr,
                                       catalogues);
}

DissectionLoop::Begin TouchScene::beginOf(const dissection::Burr& burr,
                                          std::function<std::optional<core::CameraPose>()> camera)
{
  return [burr, camera = std::move(camera)]
  {
    dissection::StrokeInfo info;
    info.startedAt = utcNow();
    info.burr = burr;
    info.camera = camera();
    return info;
  };
}

DissectionLoop::Hooks TouchScene::hooksOf(const dissection::Burr& burr,
                                          std::function<std::optional<core::CameraPose>()> camera)
{
  DissectionLoop::Hooks hooks;
  hooks.begin = beginOf(burr, std::move(camera));
  hooks.close = [this](dissection::Dissection&) { m_drill.end(); };
  return hooks;
}

} // namespace petrous::session
