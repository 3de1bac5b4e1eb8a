#include "petrous/Presenters/SegmentEditor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "Notify.h"
#include "petrous/Appearance/DistinctColors.h"
#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Presenters/MrOnCt.h"
#include "petrous/Presenters/RegionText.h"
#include "petrous/Rendering/SurfaceExtraction.h"
#include "petrous/Scene/FreeName.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Segmentation/MaskOperations.h"
#include "petrous/Segmentation/TubeTrace.h"

namespace petrous::presenters
{

namespace
{

using segmentation::Combination;
using segmentation::EditableMask;
using segmentation::Mask;
using segmentation::Tube;
using Image = std::shared_ptr<const volume::IntensityVolume>;
using Combine = SegmentValues::Combine;
using Sentences = std::vector<std::string>;

constexpr std::size_t kLeastTubePoints = 2;
constexpr char kNotShown[] = "Nothing was done: the slices do not show the image that this tool "
                             "reads.";
constexpr char kNextPoint[] = "Click the next point along the nerve.";
constexpr char kProposal[] = "proposed region"; // as a step
constexpr std::size_t kMostAtOnce = 4'000'000;  // voxels; more: in another thread
constexpr double kDeviations = 2.5;             // of a range around a click
constexpr int kSurfaceMargin = 2;               // voxels
constexpr std::uint16_t kInDraft = 1, kStrokeInside = 2, kStrokeBeside = 3; // DraftLayer's

Mask united(const Mask& a, const Mask& b, Combine how)
{
  switch (how)
  {
  case Combine::Replace:
    return b;
  case Combine::Add:
    return segmentation::combined(a, b, Combination::Union);
  case Combine::Intersect:
    break;
  }
  return segmentation::combined(a, b, Combination::Intersection);
}

core::Index3 nearestVoxel(const core::GridGeometry& grid, const Eigen::Vector3d& patient)
{
  const Eigen::Vector3d voxel = grid.voxelFromPatient(patient);
  core::Index3 nearest;
  for (std::size_t a = 0; a < 3; ++a)
    nearest[a] = static_cast<int>(std::floor(voxel[static_cast<Eigen::Index>(a)] + 0.5));
  return nearest;
}

bool isWithin(const volume::IntensityVolume& image, const Eigen::Vector3d& patient,
              const volume::ValueRange& range)
{
  const core::Index3 at = nearestVoxel(image.geometry(), patient);
  if (!image.geometry().fullBox().contains(at))
    return false;
  const double value = image.at(at[0], at[1], at[2]);
  return value >= range.min && value <= range.max;
}

// The voxels of a structure on another grid: those of the CT whose centre it contains.
Mask onGrid(const volume::LabelMap& labels, std::uint16_t index, const core::GridGeometry& ct,
            const core::Progress& progress)
{
  if (core::sameGrid(labels.voxels->geometry(), ct))
    return segmentation::maskOf(labels, index);
  const auto& from = *labels.voxels;
  const core::IndexBox extent = volume::extentOf(labels);
  auto voxels = volume::makeZeroVolume<std::uint8_t>(ct);
  if (extent.empty())
    return segmentation::emptyMask(ct);
  // One voxel more, so that the nearest ones at its border are in the box.
  core::IndexBox wider = extent;
  for (std::size_t a = 0; a < 3; ++a)
  {
    wider.lower[a] = std::max(extent.lower[a] - 1, 0);
    wider.upper[a] = std::min(extent.upper[a] + 1, from.geometry().dims()[a]);
  }
  const core::PatientBox patient = from.geometry().cropped(wider).patientBounds();
  const core::IndexBox box = ct.boxCovering(patient.min(), patient.max());
  for (int k = box.lower[2]; k < box.upper[2]; ++k)
  {
    progress.report(static_cast<double>(k - box.lower[2]) / box.size()[2], "reading the structure");
    for (int j = box.lower[1]; j < box.upper[1]; ++j)
      for (int i = box.lower[0]; i < box.upper[0]; ++i)
      {
        const core::Index3 at =
            nearestVoxel(from.geometry(), ct.patientFromVoxel(Eigen::Vector3d(i, j, k)));
        voxels->at(i, j, k) = extent.contains(at) && from.at(at[0], at[1], at[2]) == index;
      }
  }
  return segmentation::makeMask(voxels, box);
}

// False: left out, as it cannot be read; its map is an empty stand-in.
bool isThere(const scene::LabelPart& part, const scene::StructurePart& structure)
{
  const auto labels = part.labels.peek();
  return !labels || std::any_of(labels->segments.begin(), labels->segments.end(),
                                [&structure](const volume::Segment& segment)
                                { return segment.index == structure.index; });
}

// The mask's extent in cells of step^3 voxels: 1 where at least half of the voxels belong to it.
volume::Volume<std::uint16_t> coarseLabels(const Mask& mask, int step,
                                           const core::Progress& progress)
{
  core::IndexBox box;
  for (std::size_t a = 0; a < 3; ++a)
  {
    box.lower[a] = std::max(mask.extent.lower[a] - kSurfaceMargin * step, 0);
    box.upper[a] =
        std::min(mask.extent.upper[a] + kSurfaceMargin * step, mask.geometry().dims()[a]);
  }
  const core::GridGeometry full = mask.geometry().cropped(box);
  core::Index3 cells = box.size();
  for (int& size : cells)
    size = (size + step - 1) / step;
  volume::Volume<std::uint16_t> labels(core::GridGeometry(
      cells, step * full.spacing(),
      full.patientFromVoxel(Eigen::Vector3d::Constant(0.5 * (step - 1))), full.direction()));
  const int half = (step * step * step + 1) / 2;
  for (int k = 0; k < cells[2]; ++k)
  {
    progress.report(static_cast<double>(k) / cells[2], "making the surface");
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i)
      {
        int inside = 0;
        for (int n = 0; n < step * step * step; ++n)
          inside += mask.at({box.lower[0] + i * step + n % step,
                             box.lower[1] + j * step + n / step % step,
                             box.lower[2] + k * step + n / step / step});
        labels.at(i, j, k) = inside >= half;
      }
  }
  return labels;
}

// Each vertex moved along its normal, the mean of its triangles' by area.
core::TriangleMesh raised(core::TriangleMesh mesh, float millimetres)
{
  std::vector<Eigen::Vector3f> normals(mesh.vertices.size(), Eigen::Vector3f::Zero());
  for (const auto& triangle : mesh.triangles)
  {
    const Eigen::Vector3f& a = mesh.vertices[triangle[0]];
    const Eigen::Vector3f normal =
        (mesh.vertices[triangle[1]] - a).cross(mesh.vertices[triangle[2]] - a);
    for (const std::uint32_t corner : triangle)
      normals[corner] += normal;
  }
  for (std::size_t n = 0; n < normals.size(); ++n)
    if (const float length = normals[n].norm(); length > 0.0F)
      mesh.vertices[n] += millimetres / length * normals[n];
  return mesh;
}

// Whether these are the same voxels on another grid: their axes were corrected (volume::onGrid).
bool isElsewhere(const std::shared_ptr<const volume::LabelMap>& now,
                 const std::shared_ptr<const volume::LabelMap>& before)
{
  return now && before && now->voxels->data() == before->voxels->data() &&
         !core::sameGrid(now->voxels->geometry(), before->voxels->geometry());
}

bool isElsewhere(const std::shared_ptr<const volume::IntensityVolume>& now,
                 const std::shared_ptr<const volume::IntensityVolume>& before)
{
  const auto dataOf = [](const volume::IntensityVolume& image)
  {
    return std::visit([](const auto& voxels) -> const void* { return voxels->data(); },
                      image.voxels());
  };
  return now && before && dataOf(*now) == dataOf(*before) &&
         !core::sameGrid(now->geometry(), before->geometry());
}

[[noreturn]] void failAxes(const std::string& name)
{
  throw core::Error(core::Fault::Refused,
                    "the axes of '" + name + "' were corrected since: undo that first");
}

// As a step in the Undo entry.
const char* nameOf(SegmentEditor::Tool tool)
{
  using Tool = SegmentEditor::Tool;
  switch (tool)
  {
  case Tool::Threshold:
    return "threshold";
  case Tool::Paint:
    return "paint stroke";
  case Tool::Erase:
    return "erase stroke";
  case Tool::Islands:
    return "islands";
  case Tool::Margin:
    return "margin";
  case Tool::Smooth:
    return "smoothing";
  case Tool::Fill:
    return "filling between slices";
  case Tool::Grow:
    return "growing";
  case Tool::Nerve:
    return "tube";
  case Tool::None:
    break;
  }
  return "";
}

std::string millimetres(double value, int decimals)
{
  return core::fixedText(value, decimals) + " mm";
}

// `widest`: the limit of an estimated radius that follows from the structure's name.
std::string noteOf(const Tube& tube, std::optional<double> widest)
{
  std::string text = millimetres(tube.length, 1) + " long, radius " + millimetres(tube.radius, 2);
  if (tube.largestRadius - tube.smallestRadius > 0.01)
    text += " (" + core::fixedText(tube.smallestRadius, 2) + " to " +
            core::fixedText(tube.largestRadius, 2) + ")";
  if (widest)
    text += ", by its name at most " + millimetres(*widest, 2);
  return text + ".";
}

// Sentences stand on lines of their own, as each is translated by itself.
void addSentence(std::string& text, const std::string& sentence)
{
  if (!sentence.empty())
    text += (text.empty() ? "" : "\n") + sentence;
}

std::string guessText(const Tube& tube, const segmentation::TubeOptions& options)
{
  const double left = tube.length - tube.resolvedLength;
  if (left < 0.05 * tube.length)
    return {};
  if (segmentation::hasUsualRadius(tube, options))
    return "The scan does not resolve it along " + millimetres(left, 1) + " of " +
           millimetres(tube.length, 1) + ": there the path is a guess between your points.";
  return "The scan does not resolve it along " + millimetres(left, 1) + " of " +
         millimetres(tube.length, 1) +
         ": there the path and its radius are a guess between your points.";
}

std::string warningOf(const Tube& tube, const segmentation::TubeOptions& options,
                      const segmentation::TubeLabel& label)
{
  std::string text;
  if (const std::string order = likelyOrderText(tube.points); !order.empty())
    text = "The points seem not to be in their order along the structure: " + order +
           " would make a much shorter line.";
  if (const std::string bridging = bridgingText(label); !bridging.empty())
    addSentence(text, "W" + bridging.substr(1) + ".");
  addSentence(text, guessText(tube, options));
  return text;
}

} // namespace

/// The image that the tools read, as it is and on the CT's grid.
struct SegmentEditor::SourceImage
{
  Image own;                               ///< on its own grid
  Image onCt;                              ///< nullptr: to be made
  std::optional<volume::ValueRange> usual; ///< segmentation::usualRange of onCt; none: not known
  core::RigidTransform ownFromCt;
  core::GridGeometry ct;
  std::string mr; ///< empty: the primary image

  scene::MrReadings readings() const
  {
    return mr.empty() ? scene::MrReadings() : scene::MrReadings{{mr, ownFromCt, false}};
  }

  const Image& made(const core::Progress& progress)
  {
    if (!onCt)
      onCt = mrOnCt(*own, ct, ownFromCt, progress);
    return onCt;
  }

  /// Of `onCt`, which is there.
  const std::optional<volume::ValueRange>& usualRange()
  {
    if (!usual)
      usual = segmentation::usualRange(*onCt);
    return usual;
  }
};

/// What voxels were made from, and how.
struct SegmentEditor::Origin
{
  scene::MrReadings readings;
  scene::TracedTubes tubes; ///< among the voxels
  Sentences doubts;         ///< of what was done
  bool isGrown = false;     ///< from seeds, so that the finished structure is judged (regionTexts)

  bool operator==(const Origin& other) const
  {
    return readings == other.readings && tubes == other.tubes && doubts == other.doubts &&
           isGrown == other.isGrown;
  }

  void add(const Origin& other)
  {
    scene::addReadings(readings, other.readings);
    tubes += other.tubes;
    for (const std::string& text : other.doubts)
      if (std::find(doubts.begin(), doubts.end(), text) == doubts.end())
        doubts.push_back(text);
    isGrown = isGrown || other.isGrown;
  }
};

// The voxels of a structure come onto the primary image's grid, and stay there: what was drawn on
// an MR is from then on made from it.
SegmentEditor::Origin SegmentEditor::originOf(const scene::Case& value,
                                              const scene::LabelPart& part,
                                              const scene::StructurePart& structure)
{
  StructureNotes notes = notesOf(part, structure.name);
  Origin origin{structure.readings, structure.tubes, std::move(notes.texts), notes.isGrown};
  if (const scene::Placement placement = scene::placementOf(value, part);
      !placement.drawnOn.empty())
    scene::addReadings(origin.readings, {{placement.drawnOn, placement.mrFromCt, false}});
  return origin;
}

/// What the draft would be with the tool's result.
struct SegmentEditor::Preview
{
  std::optional<Mask> result; ///< none: computed only in slices, `range`
  std::shared_ptr<const Tube> tube;
  Origin made;                             ///< by the tool, but for the readings: see Reads
  std::optional<volume::ValueRange> range; ///< that was used
  std::optional<Eigen::Vector3d> seed;     ///< of the region that is proposed
  Image image;                             ///< the source on the CT's grid, if it was made
  std::optional<volume::ValueRange> usual; ///< of that image, if it was computed
  std::string note, warning;
  std::optional<Pieces> pieces; ///< of the result; one: none

  void warn(const Sentences& texts)
  {
    for (const std::string& text : texts)
      addSentence(warning, text);
  }
};

/// Everything that a draft consists of.
struct SegmentEditor::Draft
{
  explicit Draft(const core::GridGeometry& grid)
    : mask(grid)
  {
  }

  struct Step // that can be undone
  {
    const char* what = ""; ///< to the user
    bool mask = false;
    bool inside = false;
    bool beside = false;
    std::optional<std::pair<Points, Points>> points; ///< before and after
    std::optional<std::pair<Points, Points>> seeds;  ///< before and after
    std::optional<std::pair<Origin, Origin>> origin; ///< before and after
  };

  // Of a step on the voxels: `by` is what the tool adds, without readings.
  void made(Step& step, const Reads& reads, Origin by = {})
  {
    if (!step.mask)
      return;
    const bool isEmpty = mask.count() == 0; // nothing is left of what all this is of
    by.readings = isEmpty ? scene::MrReadings() : reads.readings;
    Origin after = reads.afresh || isEmpty ? Origin() : origin;
    after.add(by);
    if (after == origin)
      return;
    step.origin = {origin, after};
    origin = std::move(after);
  }

  void did(Step step)
  {
    if (!step.mask && !step.inside && !step.beside && !step.points && !step.seeds)
      return;
    undo.push_back(std::move(step));
    redo.clear();
    ++changes;
  }

  std::string name;
  std::string edited;
  std::shared_ptr<const volume::LabelMap> editedMap; ///< tells it from others, whatever its name
  std::uint16_t editedIndex = 0;                     ///< in the map
  std::optional<appearance::StructureAppearance> editedLook;
  std::string resampled; ///< how its voxels are others than in the map, to the user
  EditableMask mask;
  std::unique_ptr<EditableMask> inside, beside; ///< strokes to grow from; nullptr: none
  Eigen::Vector3d normal = axesOf(SliceOrientation::Axial).next; ///< of the slice last painted in
  Points seeds;                                                  ///< of the connected threshold
  Points points;                                                 ///< of the nerve
  Origin origin;                                                 ///< of the voxels
  std::vector<Step> undo, redo;
  std::uint64_t changes = 0;                              ///< steps ever made
  std::optional<std::pair<Pieces, std::uint64_t>> pieces; ///< and `changes` by then
  /// What a Work has done to the masks, to be recorded. While a step is under way this and the
  /// masks are the Work's, and all else is the editor's.
  std::function<void()> pending;
  // A stroke or a point that is dragged.
  bool stroking = false;
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  std::optional<std::size_t> gripped;
  Points before;
};

/// A structure just created, to be undone, and redone.
struct SegmentEditor::Created
{
  std::shared_ptr<const volume::LabelMap> labels; ///< tells it from others, whatever its name
  std::shared_ptr<Draft> draft;
  std::optional<scene::LabelPart> replaced;
  std::shared_ptr<const volume::IntensityVolume> replacedOn; ///< image that it was drawn on: an MR
  std::optional<scene::LabelPart> taken;                     ///< undone: as it was in the case
  std::uint64_t changes = 0;                                 ///< of the draft, when it was undone
  std::uint64_t step = 0;                                    ///< of WorkstationModel::edits

  std::string what() const ///< in the Undo entry
  {
    return replaced ? "change of " : "create ";
  }
};

SegmentEditor::SegmentEditor(WorkstationModel& model)
  : m_model(model)
  , m_draft(std::make_shared<Draft>(core::GridGeometry()))
{
}

SegmentEditor::~SegmentEditor() = default;

void SegmentEditor::touched()
{
  notify(events.changed);
}

// What the preview was or is being computed from is no longer so, nor why there was none.
void SegmentEditor::outdate()
{
  m_previewDue = true;
  ++m_inputs;
  if (!std::exchange(m_refused, {}).empty())
    m_warning.clear();
}

void SegmentEditor::forgetImage()
{
  m_image.reset();
  ++m_images;
}

// Whether the tool needs a preview, or the source on the CT's grid.
bool SegmentEditor::needsPreview() const
{
  return m_tool == Tool::Threshold || (m_tool == Tool::Nerve && !m_draft->points.empty()) ||
         ((m_tool == Tool::Paint || m_tool == Tool::Erase) && m_values.within && m_source != "ct");
}

// While another thread has the draft, this is shown.
void SegmentEditor::beginStep()
{
  m_stepping = true;
  m_frozen = std::make_unique<Preview>();
  m_frozen->result = m_preview && m_preview->result ? *m_preview->result : m_draft->mask.snapshot();
  m_previewDue = m_previewRunning = false;
}

void SegmentEditor::endStep()
{
  m_stepping = false;
  m_frozen.reset();
  if (const auto record = std::exchange(m_draft->pending, nullptr))
    record();
}

void SegmentEditor::reset()
{
  m_draft = std::make_shared<Draft>(m_model.hasCase() ? m_model.value().ct.geometry
                                                      : core::GridGeometry());
  m_stepping = m_proposeDue = m_proposesAgain = m_previewRunning = false;
  m_frozen.reset();
  m_stepDue.reset();
  m_surface.reset();
  m_raised.reset();
  dropPreview();
  chooseColor();
}

void SegmentEditor::caseChanged()
{
  m_tool = Tool::None;
  m_source = "ct";
  m_sourceOf = 0;
  m_mrNames.clear();
  if (m_model.hasCase())
    for (const scene::ImagePart& mr : m_model.value().mr)
      m_mrNames.push_back(mr.name);
  m_shown = {};
  forgetImage();
  m_created.reset();
  m_values = {};
  reset();
  touched();
}

void SegmentEditor::partsChanged()
{
  if (m_model.hasCase())
  {
    followNames();
    followSource();
    followEdited();
  }
  chooseColor();
  followShown();
  touched();
}

// The MR that is the source may have another name now, or be gone: what was computed from it goes
// with it then, as the limits do, which are in its unit.
void SegmentEditor::followSource()
{
  const auto& images = m_model.value().mr;
  const bool isRenamed = m_source != "ct" && !scene::findMr(m_model.value(), m_source) &&
                         images.size() == m_imagesThen && m_sourceOf < images.size();
  if (isRenamed)
    m_source = images[m_sourceOf].name;
  const scene::ImagePart* mr = scene::findMr(m_model.value(), m_source);
  m_imagesThen = images.size();
  if (m_source == "ct" || (mr && mr->registered))
  {
    m_sourceOf = mr ? static_cast<std::size_t>(mr - images.data()) : 0;
    return;
  }
  if (!m_stepping) // else a step goes on with what it was begun with
    dropPreview();
  takeSource("ct");
}

// An MR that the draft was made from may have another name now; so may those of the structure that
// is out of the case, to be put back.
void SegmentEditor::followNames()
{
  const std::vector<std::string> before = std::exchange(m_mrNames, {});
  for (const scene::ImagePart& mr : m_model.value().mr)
    m_mrNames.push_back(mr.name);
  if (before.size() != m_mrNames.size())
    return;
  const auto [from, to] = std::mismatch(before.begin(), before.end(), m_mrNames.begin());
  if (from == before.end() || !std::equal(from + 1, before.end(), to + 1))
    return;
  const auto follow = [from = *from, to = *to](scene::MrReadings& readings)
  {
    for (scene::MrReading& reading : readings)
      if (!reading.isGone && reading.mr == from)
        reading.mr = to;
  };
  const auto followIn = [&follow](Draft& draft)
  {
    follow(draft.origin.readings);
    for (auto* steps : {&draft.undo, &draft.redo})
      for (Draft::Step& step : *steps)
        if (step.origin)
        {
          follow(step.origin->first.readings);
          follow(step.origin->second.readings);
        }
  };
  followIn(*m_draft);
  if (!m_created)
    return;
  if (m_created->draft && m_created->draft != m_draft)
    followIn(*m_created->draft);
  for (auto* part : {&m_created->replaced, &m_created->taken})
    if (*part)
      for (scene::StructurePart& structure : (*part)->structures)
        follow(structure.readings);
}

// The structure that is edited may have been renamed, or taken out of the case.
void SegmentEditor::followEdited()
{
  Draft& draft = *m_draft;
  if (draft.edited.empty())
    return;
  const std::string before = std::exchange(draft.edited, {});
  for (const scene::LabelPart& part : m_model.value().labels)
    if (part.labels.peek() == draft.editedMap)
      for (const scene::StructurePart& structure : part.structures)
        if (structure.index == draft.editedIndex)
          draft.edited = structure.name;
  if (!draft.edited.empty() && draft.name == before)
    nameDraft(draft.edited);
}

// How wide a nerve may be, and what its lumen can be, follow from its name.
void SegmentEditor::nameDraft(const std::string& name)
{
  const std::string before = std::exchange(m_draft->name, name);
  if (m_tool != Tool::Nerve || !needsPreview())
    return;
  const segmentation::TubeOptions was = tubeOptionsFor(before);
  const segmentation::TubeOptions now = tubeOptionsFor(name);
  if ((!now.radius && was.widest != now.widest) || was.lumen.has_value() != now.lumen.has_value())
    outdate();
}

segmentation::TubeOptions SegmentEditor::tubeOptionsFor(const std::string& name) const
{
  return segmentation::tubeOptionsFor(name, m_values.tubeRadius,
                                      display().hounsfield && !isSourceMr());
}

void SegmentEditor::mrMoved()
{
  if (m_source == "ct")
    return followShown();
  forgetImage();
  followSource();
  if (needsPreview())
    outdate();
  followShown();
  touched();
}

bool SegmentEditor::hasDraft() const
{
  return m_stepping || m_draft->mask.count() > 0 || !m_draft->edited.empty() ||
         !m_draft->undo.empty() || !m_draft->points.empty() || !m_draft->seeds.empty() ||
         (m_preview && m_preview->result && m_preview->result->count > 0);
}

bool SegmentEditor::isUnsaved() const
{
  return m_draft->edited.empty() ? hasDraft() && !(isProposal() && m_draft->name.empty())
                                 : !m_draft->undo.empty() || !m_draft->points.empty() ||
                                       (m_preview && m_preview->result);
}

// The threshold has proposed what there is, and the user has done nothing about it.
bool SegmentEditor::isProposal() const
{
  const Draft& draft = *m_draft;
  const bool isUntouched = draft.undo.empty()
                               ? draft.seeds.empty()
                               : draft.undo.size() == 1 && draft.undo.back().what == kProposal;
  return m_tool == Tool::Threshold && isUntouched && !m_isOwnRange && !m_stepping &&
         draft.redo.empty() && draft.edited.empty() && draft.points.empty() &&
         draft.mask.count() == 0;
}

// It goes with the tool, which proposes it again.
void SegmentEditor::dropProposal()
{
  if (m_draft->seeds.empty() || !isProposal())
    return;
  m_draft->seeds.clear();
  m_draft->undo.clear();
  m_values.connected = false;
  m_proposesAgain = true;
}

const std::string& SegmentEditor::name() const noexcept
{
  return m_draft->name;
}

const std::string& SegmentEditor::edited() const noexcept
{
  return m_draft->edited;
}

void SegmentEditor::setName(const std::string& name)
{
  if (name == m_draft->name)
    return;
  nameDraft(name);
  chooseColor();
  touched();
}

std::string SegmentEditor::whyNotCreate() const
{
  if (!m_model.hasCase())
    return "No case is open.";
  if (m_stepping)
    return "A step is under way.";
  if (previewPending())
    return "The preview is being computed.";
  if (!m_refused.empty()) // the draft alone is not what the tool should have made
    return "The tool has no result: " + m_refused;
  if (voxels() == 0)
    return "There is no voxel yet: paint, or use another tool.";
  if (!m_draft->edited.empty() && m_draft->undo.empty() && !(m_preview && m_preview->result))
    return "Nothing was changed.";
  if (m_draft->name.empty())
    return "Give the structure a name.";
  try
  {
    scene::checkPartName(m_draft->name);
  }
  catch (const core::Error& error)
  {
    return error.what();
  }
  if (m_draft->name == m_draft->edited)
    return {};
  for (const std::string& taken : scene::partNames(m_model.value()))
    if (taken != m_draft->edited && scene::asRead(taken) == scene::asRead(m_draft->name))
    {
      const std::string kind = scene::kindOfPart(m_model.value(), taken);
      return "The case has " + std::string(kind == "MR" || kind == "image" ? "an " : "a ") + kind +
             " '" + shownName(taken) + "' already; choose another name.";
    }
  return {};
}

std::vector<std::string> SegmentEditor::editable() const
{
  std::vector<std::string> names;
  if (m_model.hasCase() && m_model.loaded())
    for (const scene::LabelPart& part : m_model.value().labels)
      if (scene::placementOf(m_model.value(), part).missing.empty())
        for (const scene::StructurePart& structure : part.structures)
          if (isThere(part, structure))
            names.push_back(structure.name);
  return names;
}

SegmentEditor::Work SegmentEditor::edit(const std::string& structure)
{
  if (hasDraft())
    throw core::InvalidParameter("there is a draft already; create or discard it first");
  const auto names = editable();
  if (std::find(names.begin(), names.end(), structure) == names.end())
    throw core::InvalidParameter("structure '" + structure + "' is not on the " +
                                 primaryName(m_model.value()));
  const scene::LabelPart* part = nullptr;
  const scene::StructurePart* found = nullptr;
  for (const scene::LabelPart& labels : m_model.value().labels)
    for (const scene::StructurePart& one : labels.structures)
      if (one.name == structure)
      {
        part = &labels;
        found = &one;
      }
  dropPreview();
  beginStep();
  touched();
  return [this, draft = m_draft, labels = scene::labelsOnCt(m_model.value(), *part),
          map = part->labels.get(), index = found->index, look = found->look, structure,
          origin = originOf(m_model.value(), *part, *found),
          volume = static_cast<double>(found->voxels) *
                   part->labels.get()->voxels->geometry().voxelVolume(),
          ct = m_model.value().ct.geometry, primary = std::string(primaryName(m_model.value()))](
             const core::Progress& progress) -> Apply
  {
    const auto mask = std::make_shared<EditableMask>(onGrid(*labels, index, ct, progress));
    std::string resampled;
    if (labels != map || !core::sameGrid(labels->voxels->geometry(), ct))
      resampled = "It was drawn on other voxels, and is now on those of the " + primary + ": " +
                  core::fixedText(static_cast<double>(mask->count()) * ct.voxelVolume(), 1) +
                  " mm³ for " + core::fixedText(volume, 1) +
                  " mm³. Saving replaces what was drawn.";
    return [this, draft, mask, map, index, structure, look, resampled, origin]
    {
      if (draft != m_draft)
        return;
      endStep();
      draft->mask = std::move(*mask);
      draft->name = draft->edited = structure;
      draft->editedMap = map;
      draft->editedIndex = index;
      draft->resampled = resampled;
      draft->editedLook = look;
      draft->origin = origin;
      chooseColor();
      touched();
    };
  };
}

void SegmentEditor::setTool(Tool tool)
{
  if (tool == m_tool || (tool != Tool::None && !m_model.hasCase()))
    return;
  release();
  dropProposal();
  followShown();
  m_tool = tool;
  dropPreview();
  followShown();
  if (tool == Tool::Threshold &&
      ((m_values.lower == 0.0 && m_values.upper == 0.0) || std::exchange(m_proposesAgain, false)))
    m_proposeDue = true;
  if (needsPreview())
    outdate();
  touched();
}

std::vector<SegmentEditor::Source> SegmentEditor::sources() const
{
  std::vector<Source> all;
  if (!m_model.hasCase())
    return all;
  all.push_back({"ct", {}});
  for (const scene::ImagePart& mr : m_model.value().mr)
    all.push_back({mr.name, mr.registered
                                ? std::string()
                                : std::string("not registered to the ") +
                                      primaryName(m_model.value()) + "; see Registration, F5"});
  return all;
}

std::string SegmentEditor::sourceName(const std::string& source) const
{
  return source == "ct" && m_model.hasCase() ? primaryName(m_model.value()) : source;
}

void SegmentEditor::setSource(const std::string& name)
{
  for (const Source& source : sources())
    if (source.name == name)
    {
      if (!source.why.empty())
        throw core::InvalidParameter("'" + name + "' is " + source.why);
      if (name == m_source || m_stepping)
        return;
      takeSource(name);
      return touched();
    }
  throw core::InvalidParameter("the case has no image '" + name + "'");
}

void SegmentEditor::takeSource(const std::string& name)
{
  m_source = name;
  const auto& images = m_model.value().mr;
  const scene::ImagePart* mr = scene::findMr(m_model.value(), name);
  m_sourceOf = mr ? static_cast<std::size_t>(mr - images.data()) : 0;
  m_imagesThen = images.size();
  forgetImage();
  m_proposeDue = true; // another unit
  m_isOwnRange = false;
  outdate();
}

void SegmentEditor::setShown(const ShownImages& shown)
{
  if (shown == m_shown)
    return;
  m_shown = shown;
  followShown();
  if (m_warning == kNotShown)
    m_warning.clear();
  touched();
}

std::string SegmentEditor::shownInstead() const
{
  const std::string shown = m_shown.mr.empty() ? "ct" : m_shown.mr;
  if (notShown().empty() || m_stepping)
    return {};
  for (const Source& source : sources())
    if (source.name == shown && source.why.empty())
      return shown;
  return {};
}

void SegmentEditor::followShown()
{
  if (m_tool != Tool::None || hasDraft())
    return;
  if (const std::string shown = shownInstead(); !shown.empty())
    takeSource(shown);
}

std::string SegmentEditor::notShown() const
{
  if (!m_model.hasCase() || (m_source == "ct" ? m_shown.ct : m_shown.mr == m_source))
    return {};
  const std::string ct = std::string("the ") + primaryName(m_model.value());
  const auto nameOf = [&ct](const std::string& mr)
  { return mr.empty() || mr == "ct" ? ct : "the MR '" + mr + "'"; };
  return "The slices show " + nameOf(m_shown.mr) + ", but the tools work on " + nameOf(m_source) +
         ".";
}

// The rest draws or changes what is there, whatever the image.
bool SegmentEditor::readsSource() const
{
  return m_tool == Tool::Threshold || m_tool == Tool::Grow || m_tool == Tool::Nerve ||
         ((m_tool == Tool::Paint || m_tool == Tool::Erase) && m_values.within);
}

IntensityDisplay SegmentEditor::display() const
{
  if (!m_model.hasCase())
    return {};
  const scene::Case& value = m_model.value();
  const scene::ImagePart* mr = scene::findMr(value, m_source);
  IntensityDisplay display = mr ? displayOf(*mr) : displayOf(value);
  const volume::ValueRange range = mr ? mr->range : value.ct.range;
  const double span = range.max - range.min;
  display.least = span > 0.0 ? range.min : std::min(-1024.0, display.least);
  display.most = span > 0.0 ? range.max : std::max(4096.0, display.most);
  return display;
}

void SegmentEditor::setValues(const SegmentValues& values)
{
  const SegmentValues before = std::exchange(m_values, values);
  if (m_values.lower > m_values.upper) // the one that was set pushes the other
    (m_values.lower != before.lower ? m_values.upper : m_values.lower) =
        m_values.lower != before.lower ? m_values.lower : m_values.upper;
  const bool range = m_values.lower != before.lower || m_values.upper != before.upper;
  if (range)
  {
    m_proposeDue = false;
    m_isOwnRange = true;
  }
  if (m_tool == Tool::Threshold && !m_values.connected && before.connected &&
      !m_draft->seeds.empty() && !m_stepping)
  {
    Draft::Step step;
    step.what = "removal of the points";
    step.seeds = {std::exchange(m_draft->seeds, {}), Points()};
    m_draft->did(std::move(step));
  }
  if ((m_tool == Tool::Threshold &&
       (range || m_values.connected != before.connected || m_values.combine != before.combine)) ||
      (m_tool == Tool::Nerve && m_values.tubeRadius != before.tubeRadius) ||
      (m_values.within && !before.within))
    outdate();
  if (m_values.within && m_values.lower == 0.0 && m_values.upper == 0.0)
    m_proposeDue = true;
  touched();
}

void SegmentEditor::proposeRange()
{
  if (!m_model.hasCase() || m_stepping)
    return;
  m_proposeDue = true;
  m_isOwnRange = false;
  outdate();
  touched();
}

SegmentEditor::SourceImage& SegmentEditor::image()
{
  if (!m_image)
  {
    const scene::Case& value = m_model.value();
    auto image = std::make_unique<SourceImage>(); // reading it may fail
    image->ct = value.ct.geometry;
    if (const scene::ImagePart* mr = scene::findMr(value, m_source))
    {
      image->own = mr->volume.get();
      image->ownFromCt = mr->mrFromCt;
      image->mr = mr->name;
    }
    else
      image->own = image->onCt = value.ct.volume.get();
    m_image = std::move(image);
  }
  return *m_image;
}

// That of bone, on the CT.
std::optional<double> SegmentEditor::surfaceIntensity() const
{
  return m_source == "ct" ? std::optional(m_model.value().iso) : std::nullopt;
}

bool SegmentEditor::isSourceMr() const
{
  return m_source != "ct" || m_model.value().ct.modality == scene::Modality::Mr;
}

void SegmentEditor::refuse(const std::string& why)
{
  m_warning = why;
  touched();
}

// Whether the source image has something there; else that is said.
bool SegmentEditor::checkWithin(const Eigen::Vector3d& patient)
{
  const SourceImage& source = image();
  const core::GridGeometry& grid = source.own->geometry();
  if (grid.hullContains(grid.voxelFromPatient(source.ownFromCt * patient)))
    return true;
  refuse("Nothing was done: that point lies outside of the image.");
  return false;
}

// From the pointer's last place, so that a fast stroke has no gaps.
void SegmentEditor::dab(const Eigen::Vector3d& from, const Eigen::Vector3d& to)
{
  segmentation::Brush brush;
  brush.from = from;
  brush.to = to;
  brush.radius = m_values.brush;
  if (!m_values.ball)
    brush.normal = m_draft->normal;
  if (m_tool == Tool::Grow)
  {
    EditableMask& mine = m_values.inside ? *m_draft->inside : *m_draft->beside;
    EditableMask& other = m_values.inside ? *m_draft->beside : *m_draft->inside;
    const core::IndexBox changed = segmentation::paint(mine, brush, true);
    notify(events.voxelsChanged, changed.united(segmentation::paint(other, brush, false)));
    return;
  }
  if (m_values.within)
  {
    brush.range = volume::ValueRange{m_values.lower, m_values.upper};
    brush.image = image().onCt.get();
  }
  notify(events.voxelsChanged, segmentation::paint(m_draft->mask, brush, m_tool == Tool::Paint));
}

void SegmentEditor::press(const Eigen::Vector3d& patient, SliceOrientation plane)
{
  press(patient, axesOf(plane).next);
}

void SegmentEditor::press(const Eigen::Vector3d& patient, const Eigen::Vector3d& normal)
{
  if (!m_model.hasCase() || m_tool == Tool::None)
    return;
  if (m_stepping)
    return refuse("A step is under way; wait, or stop it.");
  if (readsSource() && !notShown().empty())
    return refuse(kNotShown);
  m_warning.clear();
  Draft& draft = *m_draft;
  switch (m_tool)
  {
  case Tool::Paint:
  case Tool::Erase:
  case Tool::Grow:
    if (m_tool != Tool::Grow && m_values.within && !image().onCt)
      return refuse(std::string("The MR is being brought onto the grid of the ") +
                    primaryName(m_model.value()) + "; then its range can be used.");
    if (m_tool == Tool::Grow && !draft.inside)
    {
      draft.inside = std::make_unique<EditableMask>(draft.mask.geometry());
      draft.beside = std::make_unique<EditableMask>(draft.mask.geometry());
    }
    draft.normal = normal;
    draft.stroking = true;
    draft.last = patient;
    if (m_tool == Tool::Grow)
    {
      draft.inside->beginStep();
      draft.beside->beginStep();
    }
    else
      draft.mask.beginStep();
    return dab(patient, patient);
  case Tool::Threshold:
  {
    if (!checkWithin(patient))
      return;
    m_values.connected = true;
    Draft::Step step;
    step.what = "point";
    step.seeds = {draft.seeds, draft.seeds};
    step.seeds->second.push_back(patient);
    draft.seeds = step.seeds->second;
    draft.did(std::move(step));
    outdate();
    return touched();
  }
  case Tool::Islands:
  {
    if (draft.mask.count() == 0)
      return refuse("There is nothing yet of which an island could be kept.");
    m_stepDue = replacing(nameOf(m_tool),
                          [base = draft.mask.snapshot(), patient](const core::Progress& progress)
                          {
                            Preview preview;
                            preview.result = segmentation::islandsAt(base, {patient}, progress);
                            return preview;
                          },
                          false, {});
    return touched();
  }
  case Tool::Nerve:
  {
    draft.before = draft.points;
    draft.stroking = true;
    double nearest = kGrip;
    draft.gripped.reset();
    for (std::size_t n = 0; n < draft.points.size(); ++n)
      if (const double away = (draft.points[n] - patient).norm(); away <= nearest)
      {
        nearest = away;
        draft.gripped = n;
      }
    if (draft.gripped)
      return;
    if (!checkWithin(patient))
    {
      draft.stroking = false;
      return;
    }
    Tube bare;
    bare.points = draft.points;
    const bool isTraced = m_preview && m_preview->tube && m_preview->tube->points == draft.points;
    const std::size_t at =
        segmentation::insertionIndex(isTraced ? *m_preview->tube : bare, patient);
    draft.points.insert(draft.points.begin() + static_cast<std::ptrdiff_t>(at), patient);
    draft.gripped = at;
    return touched();
  }
  default:
    return;
  }
}

void SegmentEditor::drag(const Eigen::Vector3d& patient)
{
  Draft& draft = *m_draft;
  if (!draft.stroking)
    return;
  if (m_tool == Tool::Nerve)
  {
    if (draft.gripped && checkWithin(patient))
    {
      m_warning.clear();
      draft.points[*draft.gripped] = patient;
    }
    return touched();
  }
  dab(draft.last, patient);
  draft.last = patient;
}

void SegmentEditor::release()
{
  Draft& draft = *m_draft;
  if (!std::exchange(draft.stroking, false))
    return;
  Draft::Step step;
  step.what = nameOf(m_tool);
  if (m_tool == Tool::Nerve)
  {
    draft.gripped.reset();
    if (draft.points != draft.before)
    {
      step.what = draft.points.size() > draft.before.size() ? "point" : "move of a point";
      step.points = {draft.before, draft.points};
      outdate();
    }
  }
  else if (m_tool == Tool::Grow)
  {
    step.what = "stroke";
    step.inside = draft.inside->endStep();
    step.beside = draft.beside->endStep();
  }
  else
  {
    step.mask = draft.mask.endStep();
    draft.made(step, {readingsOfStroke(), false});
  }
  draft.did(std::move(step));
  touched();
}

// Of a stroke by hand: the MR that the slices show, and the source if its range bounds it.
scene::MrReadings SegmentEditor::readingsOfStroke()
{
  scene::MrReadings readings;
  if (m_values.within)
    readings = image().readings();
  if (const scene::ImagePart* mr = scene::findMr(m_model.value(), m_shown.mr); mr && mr->registered)
    scene::addReadings(readings, {scene::readingOf(*mr)});
  return readings;
}

std::vector<SegmentEditor::TubePoint> SegmentEditor::tubePoints() const
{
  std::vector<TubePoint> all;
  const Tube* tube = m_preview ? m_preview->tube.get() : nullptr;
  if (tube && tube->points != m_draft->points)
    tube = nullptr;
  for (std::size_t n = 0; n < m_draft->points.size(); ++n)
  {
    TubePoint point;
    point.patient = m_draft->points[n];
    if (tube)
    {
      point.distance = tube->pointDistances[n];
      point.isOutside = tube->outsideAtPoint[n] != 0;
      if (point.isOutside)
        point.problem = "beside the tube: move or remove it";
      else if (tube->resolved[tube->pointVertices[n]] == 0)
        point.problem = "cannot be resolved here";
      else if (tube->heldAtPoint[n] != 0)
        point.problem = "no axis nearby: the path is held at the point";
    }
    all.push_back(std::move(point));
  }
  return all;
}

void SegmentEditor::changePoints(const char* what, Points points)
{
  if (m_stepping || m_draft->stroking || points == m_draft->points)
    return;
  Draft::Step step;
  step.what = what;
  step.points = {m_draft->points, points};
  m_draft->did(std::move(step));
  m_draft->points = std::move(points);
  outdate();
  touched();
}

void SegmentEditor::removeTubePoint(std::size_t index)
{
  Points points = m_draft->points;
  if (index >= points.size())
    return;
  points.erase(points.begin() + static_cast<std::ptrdiff_t>(index));
  changePoints("removal of a point", std::move(points));
}

void SegmentEditor::moveTubePoint(std::size_t index, const Eigen::Vector3d& patient)
{
  Points points = m_draft->points;
  if (index >= points.size() || !checkWithin(patient))
    return;
  points[index] = patient;
  changePoints("move of a point", std::move(points));
}

void SegmentEditor::reorderTubePoint(std::size_t from, std::size_t to)
{
  Points points = m_draft->points;
  if (from >= points.size() || to >= points.size())
    return;
  const Eigen::Vector3d moved = points[from];
  points.erase(points.begin() + static_cast<std::ptrdiff_t>(from));
  points.insert(points.begin() + static_cast<std::ptrdiff_t>(to), moved);
  changePoints("order of the points", std::move(points));
}

const std::vector<Eigen::Vector3d>& SegmentEditor::path() const noexcept
{
  static const Points kNone;
  return m_preview && m_preview->tube ? m_preview->tube->line : kNone;
}

std::optional<double> SegmentEditor::shownRadius() const
{
  return m_preview && m_preview->tube ? std::optional(m_preview->tube->radius) : std::nullopt;
}

const std::vector<Eigen::Vector3d>& SegmentEditor::seeds() const noexcept
{
  return m_draft->seeds;
}

std::string SegmentEditor::warning() const
{
  std::string text = m_draft->resampled;
  addSentence(text, m_warning);
  return text;
}

void SegmentEditor::dropPreview()
{
  m_preview.reset();
  m_refused.clear();
  m_previewDue = false;
  ++m_inputs; // nor is one that is under way wanted
  m_note.clear();
  m_warning.clear();
}

// What the tool makes of the draft: computed without the editor, of copies.
SegmentEditor::Computed SegmentEditor::computed() const
{
  const Mask base = m_frozen && !m_preview ? *m_frozen->result : m_draft->mask.snapshot();
  const SegmentValues values = m_values;
  const auto only = [](Mask mask)
  {
    Preview preview;
    preview.result = std::move(mask);
    return preview;
  };
  switch (m_tool)
  {
  case Tool::Threshold:
    return [base, values, image = *m_image, seeds = m_draft->seeds, propose = m_proposeDue,
            isOwn = m_isOwnRange, iso = surfaceIntensity(), isMr = isSourceMr(),
            unit = display().suffix(),
            isHounsfield = display().hounsfield](const core::Progress& progress) mutable
    {
      Preview preview;
      preview.image = image.made(progress.part(0.0, 0.4));
      volume::ValueRange range{values.lower, values.upper};
      const core::Progress rest = progress.part(0.4, 1.0);
      const auto region = propose && isMr && seeds.empty() && base.count == 0
                              ? segmentation::proposedRegion(*image.own, progress.part(0.3, 0.4))
                              : std::nullopt;
      if (region)
      {
        const Eigen::Vector3d seed = image.ownFromCt.inverse() * region->seed;
        if (isWithin(*preview.image, seed, region->range)) // else beside the CT
        {
          preview.seed = seed;
          preview.range = region->range;
          preview.note = "The brightest region is proposed; click points for another one, or all "
                         "voxels of the range without 'connected'.";
          preview.result =
              segmentation::connectedThreshold(*preview.image, region->range, {seed}, rest, unit);
          return preview;
        }
      }
      // The clicked point says what is looked for, unless the limits were entered.
      const bool isClicked = values.connected && !seeds.empty();
      std::optional<segmentation::SeedSurroundings> surroundings;
      if (isClicked && !isOwn)
      {
        preview.usual = image.usualRange();
        surroundings = segmentation::surroundingsOf(*preview.image, seeds.back(), preview.usual);
      }
      if (isClicked && (propose || (!isOwn && !isWithin(*preview.image, seeds.back(), range))))
      {
        range = segmentation::rangeAround(*preview.image, seeds.back(), surroundings, kDeviations,
                                          rest);
        preview.note = "The limits were set around the clicked point.";
      }
      else if (propose)
        range = segmentation::proposedRange(volume::IntensityHistogram(*image.own), iso);
      preview.range = range;
      if (values.connected && seeds.empty())
      {
        preview.note = "Click a point of the structure in a slice.";
        return preview;
      }
      const Mask grown =
          isClicked ? segmentation::connectedThreshold(*preview.image, range, seeds, rest, unit)
                    : segmentation::threshold(*preview.image, range, rest);
      preview.result = united(base, grown, values.combine);
      if (isClicked)
      {
        preview.made.isGrown = true;
        for (std::string text :
             {seedText(surroundings, seeds.back(), unit),
              rangeText(range, unit, isHounsfield && !isMr ? iso : std::nullopt)})
          if (!text.empty())
            preview.made.doubts.push_back(std::move(text));
        preview.warn(preview.made.doubts);
        preview.warn(regionTexts(*preview.result));
      }
      return preview;
    };
  case Tool::Nerve:
    return [base, image = *m_image, points = m_draft->points,
            options = tubeOptionsFor(m_draft->name)](const core::Progress& progress)
    {
      Preview preview;
      Tube tube = traceOnCt(*image.own, image.ownFromCt, points, options, progress.part(0.0, 0.8));
      volume::Segment segment;
      segment.name = "tube";
      segment.index = 1;
      const segmentation::TubeLabel label =
          segmentation::labelTube(tube, base.geometry(), segment, 1.0, progress.part(0.8, 1.0));
      preview.note =
          noteOf(tube, options.radius || options.widest == segmentation::TubeOptions().widest
                           ? std::nullopt
                           : std::optional(options.widest));
      preview.warning = warningOf(tube, options, label);
      preview.made.doubts = unresolvedTexts(tube, options);
      preview.warn(preview.made.doubts);
      preview.made.tubes = tracedTubes(tube, label);
      preview.tube = std::make_shared<const Tube>(std::move(tube));
      preview.result = united(base, segmentation::maskOf(label.map, 1), Combine::Add);
      return preview;
    };
  case Tool::Islands:
    return [base, values, only](const core::Progress& progress)
    {
      return only(values.largest
                      ? segmentation::largestIsland(base, progress)
                      : segmentation::withoutSmallIslands(base, values.smallest, progress));
    };
  case Tool::Margin:
    return [base, values, only](const core::Progress& progress)
    { return only(segmentation::margin(base, values.margin, progress)); };
  case Tool::Smooth:
    return [base, values, only](const core::Progress& progress)
    { return only(segmentation::smoothedOutline(base, values.smoothing, progress)); };
  case Tool::Fill:
  {
    Eigen::Index axis = 0;
    (base.geometry().voxelFromPatientLinear() * m_draft->normal)
        .cwiseProduct(base.geometry().spacing())
        .cwiseAbs()
        .maxCoeff(&axis);
    return [base, only, axis](const core::Progress& progress)
    { return only(segmentation::filledBetweenSlices(base, static_cast<int>(axis), progress)); };
  }
  case Tool::Grow:
    return [image = *m_image, inside = m_draft->inside->snapshot(),
            beside = m_draft->beside->snapshot()](const core::Progress& progress) mutable
    {
      Preview preview;
      preview.image = image.made(progress.part(0.0, 0.4));
      preview.result =
          segmentation::grownFromSeeds(*preview.image, inside, beside, {}, progress.part(0.4, 0.9));
      const auto islands = segmentation::islandsOf(*preview.result, progress.part(0.9, 1.0));
      if (islands.count > 1)
        preview.pieces =
            Pieces{islands.count, static_cast<double>(preview.result->count - islands.largest) *
                                      preview.result->geometry().voxelVolume()};
      return preview;
    };
  default:
    return {};
  }
}

void SegmentEditor::show(const Preview& preview)
{
  if (preview.image && m_image)
  {
    m_image->onCt = preview.image;
    if (preview.usual)
      m_image->usual = preview.usual;
  }
  if (preview.range && (m_proposeDue || !m_isOwnRange))
  {
    m_values.lower = preview.range->min;
    m_values.upper = preview.range->max;
    m_proposeDue = false;
  }
  m_note = preview.note;
  m_warning = preview.warning;
}

std::optional<SegmentEditor::Work> SegmentEditor::dueWork()
{
  if (m_stepping || m_draft->stroking || !m_model.hasCase())
    return std::nullopt;
  if (m_stepDue)
  {
    Work work = std::move(*m_stepDue);
    m_stepDue.reset();
    beginStep();
    touched();
    return work;
  }
  if (!m_previewDue)
    return std::nullopt;
  return previewWork();
}

std::optional<SegmentEditor::Work> SegmentEditor::previewWork()
{
  m_previewDue = false;
  try
  {
    image();
  }
  catch (const core::Error& error) // an MR whose file is lost
  {
    m_previewRunning = false;
    dropPreview();
    m_refused = m_warning = error.what();
    touched();
    return std::nullopt;
  }
  if (m_tool == Tool::Nerve && m_draft->points.size() < kLeastTubePoints)
  {
    m_previewRunning = false;
    dropPreview();
    if (!m_draft->points.empty())
      m_note = kNextPoint;
    touched();
    return std::nullopt;
  }
  if (m_note == kNextPoint)
    m_note.clear();
  m_previewRunning = true;
  m_previewOf = m_inputs;
  Computed compute;
  if (m_tool == Tool::Threshold || m_tool == Tool::Nerve)
    compute = computed();
  else // only the image and a range are needed
    compute = [image = *m_image, propose = m_proposeDue,
               iso = surfaceIntensity()](const core::Progress& progress) mutable
    {
      Preview preview;
      preview.image = image.made(progress);
      if (propose)
        preview.range = segmentation::proposedRange(volume::IntensityHistogram(*image.own), iso);
      return preview;
    };
  return [this, draft = m_draft, tool = m_tool, inputs = m_inputs,
          compute = std::move(compute)](const core::Progress& progress) -> Apply
  {
    const auto preview = std::make_shared<Preview>();
    std::string refused;
    try
    {
      *preview = compute(progress);
    }
    catch (const core::InvalidParameter& error)
    {
      refused = error.what();
    }
    return [this, draft, tool, inputs, preview, refused]
    {
      m_previewRunning = false;
      if (draft != m_draft || tool != m_tool || inputs != m_inputs)
        return;
      show(*preview);
      if (preview->seed)
      {
        Draft::Step step;
        step.what = kProposal;
        step.seeds = {draft->seeds, Points{*preview->seed}};
        draft->seeds = step.seeds->second;
        draft->did(std::move(step));
        m_values.connected = true;
      }
      m_refused = refused;
      m_warning = refused.empty() ? m_warning : refused;
      m_preview = preview->result ? std::make_unique<Preview>(std::move(*preview)) : nullptr;
      touched();
    };
  };
}

std::string SegmentEditor::whyNotStep() const
{
  if (!m_model.hasCase())
    return "No case is open.";
  if (m_stepping)
    return "A step is under way.";
  const auto strokes = [](const std::unique_ptr<EditableMask>& mask)
  { return mask && mask->count() > 0; };
  switch (m_tool)
  {
  case Tool::None:
    return "Choose a tool first.";
  case Tool::Paint:
  case Tool::Erase:
    return "This tool works while you drag in a slice.";
  case Tool::Threshold:
    return m_values.connected && m_draft->seeds.empty()
               ? "Click a point of the structure in a slice first."
               : "";
  case Tool::Nerve:
    return m_draft->points.size() < kLeastTubePoints
               ? "Click at least two points along the nerve first."
               : "";
  case Tool::Grow:
    return strokes(m_draft->inside) && strokes(m_draft->beside)
               ? ""
               : "Paint a stroke inside the structure and one beside it first.";
  case Tool::Margin:
    if (m_values.margin == 0.0)
      return "A margin of 0 mm changes nothing.";
    break;
  default:
    break;
  }
  return m_draft->mask.count() == 0 ? "There is nothing yet that could be changed." : "";
}

// `endsTool`: seeds and points have served their purpose.
SegmentEditor::Work SegmentEditor::replacing(const char* what,
                                             std::function<Preview(const core::Progress&)> compute,
                                             bool endsTool, const Reads& reads)
{
  return [this, draft = m_draft, endsTool, what, images = m_images, isOfImage = readsSource(),
          reads, compute = std::move(compute)](const core::Progress& progress) -> Apply
  {
    const auto preview = std::make_shared<Preview>(compute(progress));
    bool changed = false;
    core::IndexBox box;
    if (preview->result)
    {
      draft->mask.beginStep();
      box = draft->mask.replace(*preview->result);
      changed = draft->mask.endStep();
      draft->pending = [draft = draft.get(), changed, endsTool, what, reads,
                        pieces = preview->pieces, made = preview->made]
      {
        Draft::Step step;
        step.what = what;
        step.mask = changed;
        draft->made(step, reads, made);
        if (endsTool)
        {
          if (!draft->seeds.empty())
            step.seeds = {std::exchange(draft->seeds, {}), Points()};
          if (!draft->points.empty())
            step.points = {std::exchange(draft->points, {}), Points()};
        }
        draft->did(std::move(step));
        draft->pieces.reset();
        if (pieces)
          draft->pieces = {*pieces, draft->changes};
      };
    }
    return [this, draft, preview, changed, box, images, isOfImage]
    {
      if (draft != m_draft)
        return;
      endStep();
      const bool isOutdated = isOfImage && images != m_images;
      if (isOutdated) // its voxels lie where the image was
        preview->image.reset();
      show(*preview);
      const std::string note = m_note;
      const std::string warning = isOutdated
                                      ? "The image was moved or changed while this was computed: "
                                        "the result is that of before. Undo it, and apply the tool "
                                        "again."
                                      : m_warning;
      if (preview->result)
      {
        dropPreview();
        m_note = changed ? note : "This changes nothing.";
        m_warning = warning;
      }
      notify(events.voxelsChanged, box);
      touched();
    };
  };
}

// Of the tool's result.
SegmentEditor::Reads SegmentEditor::readsOfTool()
{
  const bool isOfImage = m_tool == Tool::Threshold || m_tool == Tool::Grow || m_tool == Tool::Nerve;
  const bool afresh =
      m_tool == Tool::Grow || (m_tool == Tool::Threshold && m_values.combine == Combine::Replace);
  return {isOfImage ? image().readings() : scene::MrReadings(), afresh};
}

std::optional<SegmentEditor::Work> SegmentEditor::stepWork()
{
  if (m_draft->stroking || !whyNotStep().empty())
    return std::nullopt;
  image();
  beginStep();
  Work work = replacing(nameOf(m_tool), computed(),
                        m_tool == Tool::Threshold || m_tool == Tool::Nerve, readsOfTool());
  touched();
  return work;
}

void SegmentEditor::workEnded()
{
  m_previewRunning = false;
  if (m_stepping)
    endStep();
  touched();
}

void SegmentEditor::workFailed(const std::string& why)
{
  const bool isOfPreview = m_previewRunning && !m_stepping && m_previewOf == m_inputs;
  workEnded();
  if (!isOfPreview)
    return;      // of what was changed meanwhile another one is due
  dropPreview(); // of what was set before
  m_refused = m_warning = why;
  touched();
}

void SegmentEditor::workDropped()
{
  if (m_previewRunning)
    outdate();
  workEnded();
}

bool SegmentEditor::canUndo() const
{
  if (m_stepping || m_draft->stroking)
    return false;
  if (m_draft->undo.empty())
    return m_created && !m_created->taken && !hasDraft();
  return !m_draft->undo.back().mask || m_draft->mask.canUndo(); // old steps are forgotten
}

bool SegmentEditor::hasSteps() const
{
  return !m_draft->undo.empty();
}

bool SegmentEditor::hasUndoneSteps() const
{
  return !m_draft->redo.empty();
}

bool SegmentEditor::canRedo() const
{
  return !m_stepping && !m_draft->stroking && (!m_draft->redo.empty() || canCreateAgain());
}

// nullptr: it is not in the case any more.
const scene::LabelPart* SegmentEditor::partOf(const Created& created) const
{
  if (m_model.hasCase())
    for (const scene::LabelPart& part : m_model.value().labels)
      if (part.labels.peek() == created.labels)
        return &part;
  return nullptr;
}

std::string SegmentEditor::undoText() const
{
  if (!canUndo())
    return {};
  if (!m_draft->undo.empty())
    return m_draft->undo.back().what;
  const scene::LabelPart* part = partOf(*m_created);
  if (!part)
    return "create"; // says why it cannot be undone
  return m_created->what() + part->structures.front().name;
}

std::string SegmentEditor::redoText() const
{
  if (!canRedo())
    return {};
  if (!m_draft->redo.empty())
    return m_draft->redo.back().what;
  return (m_draft->edited.empty() ? "create " : "change of ") +
         m_created->taken->structures.front().name;
}

// The draft is still the one that the structure was.
bool SegmentEditor::canCreateAgain() const
{
  return m_created && isDraftOf(*m_created) && m_draft->redo.empty();
}

// And nothing would be lost with it.
bool SegmentEditor::isDraftOf(const Created& created) const
{
  return created.taken && created.draft == m_draft && created.changes == m_draft->changes &&
         created.taken->structures.front().name == m_draft->name && !previewPending() &&
         !(m_preview && m_preview->result) && !m_stepping && !m_draft->stroking;
}

bool SegmentEditor::undo()
{
  if (!canUndo())
    return false;
  Draft& draft = *m_draft;
  if (draft.undo.empty())
  {
    undoCreated(m_created);
    m_model.edits().undone(m_created->step);
    return true;
  }
  if (draft.undo.back().mask && draft.mask.extent().count() > kMostAtOnce)
    m_stepDue = stepping(true);
  else
    step(draft, true)();
  touched();
  return false;
}

// The structure may have another name by now, and its name another structure.
// It becomes the draft again, unless another one would be lost.
void SegmentEditor::undoCreated(const std::shared_ptr<Created>& made)
{
  Created& created = *made;
  const scene::Case& value = m_model.value();
  const scene::LabelPart* found = partOf(created);
  // What was drawn on the grid of before would come back beside what is elsewhere by now.
  for (const scene::LabelPart& part : value.labels)
    if (const auto labels = part.labels.peek();
        isElsewhere(labels, created.labels) ||
        (created.replaced && isElsewhere(labels, created.replaced->labels.peek())))
      failAxes(part.structures.front().name);
  if (!found)
    throw core::InvalidParameter("the structure that was created is not in the case any more");
  const std::string name = found->structures.front().name;
  if (created.replaced)
  {
    const std::string& before = created.replaced->structures.front().name;
    if (before != name)
      checkFree(before);
    if (auto& mr = created.replaced->drawnOn; mr && !mr->empty())
    {
      const auto on = std::find_if(value.mr.begin(), value.mr.end(),
                                   [&created](const scene::ImagePart& image)
                                   { return image.volume.get() == created.replacedOn; });
      for (const scene::ImagePart& image : value.mr)
        if (isElsewhere(image.volume.peek(), created.replacedOn))
          failAxes(image.name);
      if (on == value.mr.end())
        throw core::InvalidParameter("'" + before + "' cannot come back: the MR '" + *mr +
                                     "' on which it was drawn is not in the case any more");
      mr = on->name; // it may have been renamed
    }
  }
  const bool becomesDraft = created.draft && (!hasDraft() || (m_created && isDraftOf(*m_created)));
  created.taken = m_model.takeStructure(name);
  if (becomesDraft)
  {
    m_created = made;
    m_draft = created.draft;
    m_draft->name = name;
    m_draft->edited.clear();
    created.changes = m_draft->changes;
    dropPreview();
  }
  if (created.replaced)
  {
    m_model.putStructure(*created.replaced, created.taken ? &*created.taken : nullptr);
    if (becomesDraft)
      m_draft->edited = created.replaced->structures.front().name;
  }
  if (becomesDraft)
    chooseColor();
  touched();
}

void SegmentEditor::createAgain(Created& created)
{
  if (!created.taken)
    throw core::InvalidParameter("the structure is in the case already");
  const bool wasDraft = isDraftOf(created);
  const std::string name = created.taken->structures.front().name;
  const std::string edited = wasDraft           ? m_draft->edited
                             : created.replaced ? created.replaced->structures.front().name
                                                : std::string();
  if (name != edited)
    checkFree(name);
  keepReplaced(created, edited.empty() ? std::nullopt : m_model.takeStructure(edited));
  m_model.putStructure(*std::exchange(created.taken, std::nullopt),
                       created.replaced ? &*created.replaced : nullptr);
  if (wasDraft)
  {
    m_tool = Tool::None;
    reset();
    followShown();
  }
  touched();
  notify(events.created, name);
}

void SegmentEditor::keepReplaced(Created& created, std::optional<scene::LabelPart> part)
{
  created.replaced = std::move(part);
  created.replacedOn.reset();
  if (created.replaced && created.replaced->drawnOn)
    if (const auto* mr = scene::findMr(m_model.value(), *created.replaced->drawnOn))
      created.replacedOn = mr->volume.get();
}

void SegmentEditor::checkFree(const std::string& name) const
{
  const auto names = scene::partNames(m_model.value());
  if (std::find(names.begin(), names.end(), name) != names.end())
    throw core::InvalidParameter("'" + name +
                                 "' cannot come back: another part has its name now; rename that "
                                 "one first");
}

// Undoes or redoes. Changes the masks alone, so that another thread may call it while a step is
// under way; what is returned does the rest, in the editor's.
std::function<void()> SegmentEditor::step(Draft& draft, bool back)
{
  const Draft::Step step = (back ? draft.undo : draft.redo).back();
  const auto turn = [back](EditableMask& mask) { return back ? mask.undo() : mask.redo(); };
  core::IndexBox box;
  if (step.mask)
    box = turn(draft.mask);
  if (step.inside)
    box = box.united(turn(*draft.inside));
  if (step.beside)
    box = box.united(turn(*draft.beside));
  return [this, draft = &draft, step, back, box]
  {
    if (step.origin)
      draft->origin = back ? step.origin->first : step.origin->second;
    if (step.points)
      draft->points = back ? step.points->first : step.points->second;
    if (step.seeds)
    {
      draft->seeds = back ? step.seeds->first : step.seeds->second;
      m_values.connected = m_values.connected || !draft->seeds.empty(); // only then do they count
    }
    auto& from = back ? draft->undo : draft->redo;
    from.pop_back();
    (back ? draft->redo : draft->undo).push_back(step);
    if (m_tool == Tool::Threshold || m_tool == Tool::Nerve)
      outdate();
    notify(events.voxelsChanged, box);
  };
}

SegmentEditor::Work SegmentEditor::stepping(bool back)
{
  dropPreview();
  return [this, draft = m_draft, back](const core::Progress& progress) -> Apply
  {
    progress.report(0.0, back ? "undoing" : "redoing");
    draft->pending = step(*draft, back); // recorded also if nobody takes it over
    return [this, draft]
    {
      if (draft != m_draft)
        return;
      endStep();
      touched();
    };
  };
}

void SegmentEditor::redo()
{
  if (!canRedo())
    return;
  Draft& draft = *m_draft;
  if (draft.redo.empty())
  {
    const auto created = m_created;
    createAgain(*created);
    m_model.edits().redone(created->step);
    return;
  }
  if (draft.redo.back().mask && draft.mask.extent().count() > kMostAtOnce)
    m_stepDue = stepping(false);
  else
    step(draft, false)();
  touched();
}

void SegmentEditor::create()
{
  createWork()({})();
}

SegmentEditor::Work SegmentEditor::createWork()
{
  release();
  if (const std::string why = whyNotCreate(); !why.empty())
    throw core::InvalidParameter(why);
  const std::optional<Mask> preview = m_preview ? m_preview->result : std::nullopt;
  const Origin made = m_preview ? m_preview->made : Origin();
  beginStep();
  volume::Segment segment;
  segment.name = m_draft->name;
  segment.index = 1;
  touched();
  return [this, draft = m_draft, mask = *m_frozen->result, preview = preview.has_value(), segment,
          what = nameOf(m_tool), made,
          reads = preview ? readsOfTool() : Reads()](const core::Progress& progress) -> Apply
  {
    progress.report(0.0, "making the structure");
    const auto labels = std::make_shared<volume::LabelMap>(segmentation::labelMapOf(mask, segment));
    if (preview) // an undo gives the draft with what was a preview
    {
      progress.report(0.5, "making the structure");
      draft->mask.beginStep();
      draft->mask.replace(mask);
      const bool changed = draft->mask.endStep();
      draft->pending = [draft = draft.get(), changed, what, reads, made]
      {
        Draft::Step step;
        step.what = what;
        step.mask = changed;
        draft->made(step, reads, made);
        draft->did(std::move(step));
      };
    }
    return [this, draft, labels, name = segment.name, region = regionTexts(mask)]
    {
      if (draft != m_draft)
        return;
      endStep();
      dropPreview();
      Sentences notes = draft->origin.doubts;
      if (draft->origin.isGrown)
        notes.insert(notes.end(), region.begin(), region.end());
      std::optional<scene::LabelPart> replaced;
      try
      {
        replaced = m_model.addStructure(std::move(*labels), draft->edited, readingsOfDraft(),
                                        draft->origin.tubes, notes);
      }
      catch (const core::InvalidParameter& error) // its name has been taken meanwhile
      {
        return refuse(error.what());
      }
      if (m_created)
        m_created->draft.reset(); // large; an undo takes that structure out, and it is no draft
      m_created = std::make_shared<Created>();
      m_created->labels = m_model.value().labels.back().labels.peek();
      m_created->draft = draft;
      keepReplaced(*m_created, std::move(replaced));
      m_created->step = m_model.edits().did({m_created->what() + name,
                                             {},
                                             [this, made = m_created] { undoCreated(made); },
                                             [this, made = m_created] { createAgain(*made); },
                                             true});
      m_tool = Tool::None;
      reset();
      followShown();
      touched();
      notify(events.created, name);
    };
  };
}

// An MR that was removed meanwhile may come back, or another one of its name.
scene::MrReadings SegmentEditor::readingsOfDraft() const
{
  scene::MrReadings readings = m_draft->origin.readings;
  for (scene::MrReading& reading : readings)
    reading.isGone = reading.isGone || !scene::findMr(m_model.value(), reading.mr);
  return readings;
}

void SegmentEditor::discard()
{
  release();
  if (m_created && m_created->taken)
    m_created.reset();
  reset();
  followShown();
  touched();
}

bool SegmentEditor::hasStrokes() const
{
  const auto drawn = [](const std::unique_ptr<EditableMask>& mask)
  { return mask && mask->count() > 0; };
  return !m_stepping && (drawn(m_draft->inside) || drawn(m_draft->beside)); // else the Work's
}

std::optional<SegmentEditor::Pieces> SegmentEditor::pieces() const
{
  const bool isOf = m_draft->pieces && m_draft->pieces->second == m_draft->changes &&
                    m_draft->redo.empty() && !m_stepping;
  return isOf ? std::optional(m_draft->pieces->first) : std::nullopt;
}

void SegmentEditor::keepLargest()
{
  if (!pieces() || m_draft->stroking)
    return;
  m_stepDue = replacing(nameOf(Tool::Islands),
                        [base = m_draft->mask.snapshot()](const core::Progress& progress)
                        {
                          Preview preview;
                          preview.result = segmentation::largestIsland(base, progress);
                          return preview;
                        },
                        false, {});
  touched();
}

std::uint64_t SegmentEditor::voxels() const
{
  if (m_frozen)
    return m_frozen->result->count;
  return m_preview && m_preview->result ? m_preview->result->count : m_draft->mask.count();
}

double SegmentEditor::volume() const
{
  return static_cast<double>(voxels()) * m_draft->mask.geometry().voxelVolume();
}

void SegmentEditor::chooseColor()
{
  m_color = colorNow();
}

// As the structure will have it.
std::array<float, 3> SegmentEditor::colorNow() const
{
  const auto& edited = m_draft->editedLook;
  if (edited && (m_draft->name == m_draft->edited || keepsLook(m_draft->name, edited->preset)))
    return edited->color;
  const auto look = appearance::StructurePresets::builtIn().lookFor(m_draft->name);
  if (look.preset != "other" || !m_model.hasCase())
    return look.color;
  return appearance::DistinctColors(structureColors(m_model.value())).next();
}

DraftLayer SegmentEditor::layer() const
{
  DraftLayer layer;
  if (!m_model.hasCase())
    return layer;
  const bool strokes = m_tool == Tool::Grow && m_draft->inside;
  const bool preview = m_preview && m_preview->result;
  if (!m_frozen && !strokes && !preview && m_draft->mask.count() == 0 && !m_draft->stroking &&
      m_draft->undo.empty() && m_tool == Tool::None)
    return layer;
  layer.geometry = m_draft->mask.geometry();
  std::array<float, 3> bright = color();
  for (float& channel : bright)
    channel *= 255.0F;
  layer.colors = {{}, bright, kInsideStroke, kBesideStroke};
  layer.hatched = kStrokeBeside;
  const bool range = m_tool == Tool::Threshold && !m_values.connected && previewPending() &&
                     !m_proposeDue && m_image && m_image->onCt;
  if (m_frozen)
    layer.indexAt = [mask = *m_frozen->result](const core::Index3& at)
    { return mask.at(at) ? kInDraft : std::uint16_t{0}; };
  else if (range) // until it is computed
    layer.indexAt = [draft = m_draft, image = m_image->onCt, lower = m_values.lower,
                     upper = m_values.upper, how = m_values.combine](const core::Index3& at)
    {
      const double value = image->at(at[0], at[1], at[2]);
      const bool in = value >= lower && value <= upper;
      const bool drawn = draft->mask.voxels().at(at[0], at[1], at[2]) != 0;
      const bool both = how == Combine::Replace ? in
                        : how == Combine::Add   ? in || drawn
                                                : in && drawn;
      return both ? kInDraft : std::uint16_t{0};
    };
  else if (preview)
    layer.indexAt = [mask = *m_preview->result](const core::Index3& at)
    { return mask.at(at) ? kInDraft : std::uint16_t{0}; };
  else
    layer.indexAt = [draft = m_draft, strokes](const core::Index3& at) -> std::uint16_t
    {
      const auto in = [&at](const EditableMask& mask)
      { return mask.voxels().at(at[0], at[1], at[2]) != 0; };
      if (strokes && draft->inside && in(*draft->inside))
        return kStrokeInside;
      if (strokes && draft->beside && in(*draft->beside))
        return kStrokeBeside;
      return in(draft->mask) ? kInDraft : std::uint16_t{0};
    };
  return layer;
}

SegmentEditor::Work SegmentEditor::surfaceWork()
{
  std::optional<Mask> mask;
  if (m_model.hasCase() && !m_stepping && voxels() > 0)
    mask = m_preview && m_preview->result ? *m_preview->result : m_draft->mask.snapshot();
  return [this, mask](const core::Progress& progress) -> Apply
  {
    std::shared_ptr<const core::TriangleMesh> surface, lifted;
    int step = 1;
    if (mask && !mask->extent.empty())
    {
      while (mask->count / (static_cast<std::uint64_t>(step) * step * step) > kMostSurfaceVoxels)
        ++step;
      surface = std::make_shared<const core::TriangleMesh>(rendering::extractLabel(
          coarseLabels(*mask, step, progress.part(0.0, 0.3)), 1, progress.part(0.3, 1.0)));
      lifted = std::make_shared<const core::TriangleMesh>(
          raised(*surface, static_cast<float>(0.5 * mask->geometry().spacing().maxCoeff())));
    }
    return [this, surface, lifted, step]
    {
      m_surface = surface;
      m_raised = lifted;
      m_surfaceStep = step;
    };
  };
}

} // namespace petrous::presenters
