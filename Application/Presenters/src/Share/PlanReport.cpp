#include "petrous/Presenters/PlanReport.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "ReportWords.h"
#include "petrous/Appearance/StructurePresets.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Dissection/StrokeNumber.h"
#include "petrous/Presenters/CaseNaming.h"
#include "petrous/Presenters/CasePicture.h"
#include "petrous/Presenters/DissectionDistances.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/LabelledPicture.h"
#include "petrous/Presenters/Measuring.h"
#include "petrous/Presenters/ProvenanceText.h"
#include "petrous/Presenters/SlicePlanes.h"
#include "petrous/Presenters/SlicePresenter.h"
#include "petrous/Rendering/OffscreenView.h"
#include "petrous/Rendering/PrintPicture.h"
#include "petrous/Rendering/RenderingError.h"
#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/Branches.h"
#include "petrous/Scene/GoneNames.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Scene/StructureOccupancy.h"

namespace petrous::presenters
{

namespace
{

using dissection::History;
using Eigen::Vector3d;

constexpr std::size_t kMostRows = 200;     // of a table
constexpr std::size_t kMostPlaces = 4;     // marks with slices
constexpr std::size_t kMostStructures = 8; // with slices
constexpr double kTooFar = 15.0;           // mm: a structure beyond gets no slices

std::string filled(std::string text, const std::string& first, const std::string& second = {})
{
  for (const auto& [marker, value] : {std::pair("%1", &first), std::pair("%2", &second)})
    if (const std::size_t at = text.find(marker); at != std::string::npos)
      text.replace(at, 2, *value);
  return text;
}

/// Replaces typed texts that may tell who the patient is by what they name and a number.
class Withheld
{
public:
  explicit Withheld(const ReportOptions& options)
    : m_options(options)
  {
  }

  std::string name(const std::string& typed, const char* kind)
  {
    if (!withholds(typed))
      return kept(typed);
    std::string& other = m_names[typed];
    if (other.empty())
      other = reportText(m_options.language, kind) + " " + std::to_string(m_names.size()) + " (" +
              reportText(m_options.language, "withheld") + ")";
    return other;
  }

  /// A line of the description; empty: it is withheld.
  std::string line(const std::string& typed) { return withholds(typed) ? "" : kept(typed); }

  /// Whether it withholds a sentence of the program.
  bool withholdsSentence(const std::string& text) const
  {
    const auto& mayIdentify =
        m_options.mayIdentifySentence ? m_options.mayIdentifySentence : m_options.mayIdentify;
    return !m_options.keepIdentity && (!mayIdentify || mayIdentify(text));
  }

  /// Of the program, with names of parts in it.
  std::string sentence(std::string text) const
  {
    for (const auto& [typed, other] : m_names)
      for (std::size_t at = 0; (at = text.find(typed, at)) != std::string::npos; at += other.size())
        text.replace(at, typed.size(), other);
    return text;
  }

  /// What stands as it was typed, and is not of words of the field alone: "'a', 'b'".
  std::string keptTexts() const
  {
    std::string all;
    for (const std::string& typed : m_kept)
      all += (all.empty() ? "'" : ", '") + typed + "'";
    return all;
  }

private:
  std::string kept(const std::string& typed)
  {
    if (!typed.empty() && typed != History::kMain &&
        !(m_options.isOfField && m_options.isOfField(typed)))
      m_kept.insert(typed);
    return typed;
  }

  bool withholds(const std::string& typed) const
  {
    return !m_options.keepIdentity && !typed.empty() &&
           (!m_options.mayIdentify || m_options.mayIdentify(typed));
  }

  const ReportOptions& m_options;
  std::map<std::string, std::string> m_names;
  std::set<std::string> m_kept;
};

// Before the names are: those of parts that are gone, or called otherwise by now, are nobody's
// any more to replace. Empty: withheld.
void withholdNotes(scene::Case& value, const Withheld& withheld, bool keepIdentity)
{
  const scene::Case before = value;
  const auto withhold = [&](std::vector<std::string>& notes)
  {
    for (std::string& note : notes)
      if (!keepIdentity &&
          (withheld.withholdsSentence(note) || !scene::quotesOnlyParts(before, note)))
        note.clear();
  };
  withhold(value.ct.notes);
  for (scene::ImagePart& mr : value.mr)
    withhold(mr.notes);
  for (scene::LabelPart& part : value.labels)
    withhold(part.notes);
  for (scene::MeshPart& mesh : value.meshes)
    withhold(mesh.notes);
}

// Everything downstream, such as the remarks of measurements, has the names of the copy.
void withholdNames(scene::Case& value, Withheld& withheld)
{
  const auto structure = [&](std::string& name) { name = withheld.name(name, "structure"); };
  const auto image = [&](std::string& name) { name = withheld.name(name, "Image"); };
  const auto look = [&](appearance::StructureAppearance& one) { image(one.sourceImage); };
  look(value.boneLook);
  look(value.softTissue);
  for (scene::ImagePart& mr : value.mr)
  {
    image(mr.name);
    if (mr.registration)
      image(mr.registration->through);
  }
  for (scene::LabelPart& part : value.labels)
  {
    if (part.drawnOn)
      image(*part.drawnOn);
    for (scene::StructurePart& one : part.structures)
    {
      structure(one.name);
      look(one.look);
      for (scene::MrReading& reading : one.readings)
        image(reading.mr);
    }
  }
  for (scene::MeshPart& mesh : value.meshes)
  {
    structure(mesh.name);
    image(mesh.drawnOn);
    look(mesh.look);
  }
  for (scene::Measurement& one : value.measurements)
  {
    one.name = withheld.name(one.name, "measurement");
    structure(one.structure);
    image(one.image);
    std::for_each(one.images.begin(), one.images.end(), image);
    for (scene::MrReading& reading : one.readings)
      image(reading.mr);
  }
  for (scene::ImagePart& mr : value.mr)
    if (mr.registration)
    {
      mr.registration->text = withheld.sentence(mr.registration->text);
      if (mr.registration->error)
        mr.registration->error->place = withheld.sentence(mr.registration->error->place);
    }
}

/// Puts one report together.
class Assembly
{
public:
  Assembly(scene::Case value, const ReportOptions& options)
    : m_value(std::move(value))
    , m_options(options)
    , m_withheld(options)
  {
  }

  PlanReport make(const core::Progress& progress)
  {
    chooseApproach();
    progress.report(0.0, "measuring distances");
    auto distances = dissectionDistances(m_value, progress.part(0.0, 0.25));
    withholdNotes(m_value, m_withheld, m_options.keepIdentity);
    withholdNames(m_value, m_withheld);
    m_known = scene::structureOccupancies(m_value);
    m_absent = absentStructures();
    for (DissectionDistance& one : distances)
      one.name = m_withheld.name(one.name, "structure");
    addHead();
    addViews(progress.part(0.25, 0.5));
    addDistances(distances);
    addNearest(distances, progress.part(0.5, 0.65));
    addPlaces(progress.part(0.65, 0.7));
    addApproaches();
    addStrokes();
    addMeasurements();
    addStructures(progress.part(0.7, 1.0));
    addRegistrations();
    addAssumptions();
    finish();
    progress.report(1.0, "writing the report");
    return std::move(m_report);
  }

private:
  std::string say(const std::string& english) const
  {
    return reportText(m_options.language, english);
  }

  std::string number(double value, int decimals) const
  {
    return reportNumber(m_options.language, core::fixedText(value, decimals));
  }

  std::string date(const std::string& iso) const { return reportDate(m_options.language, iso); }

  ReportSection& section(const char* id, const std::string& title)
  {
    ReportSection next;
    next.id = id;
    next.title = title;
    m_report.sections.push_back(std::move(next));
    return m_report.sections.back();
  }

  void chooseApproach()
  {
    const History& history = m_value.dissection.history();
    if (!m_options.approach.empty())
    {
      std::string name = m_options.approach;
      const auto number = core::parseDouble(name);
      if (!history.find(name) && number && *number >= 1.0 &&
          *number <= static_cast<double>(history.branches().size()) &&
          *number == std::floor(*number))
        name = history.branches()[static_cast<std::size_t>(*number) - 1].name;
      if (name != history.branch().name)
        scene::goToBranch(m_value, name); // throws, listing the branches
    }
    m_approach = approachName(m_value.dissection.history().branch().name);
  }

  std::string approachName(const std::string& typed)
  {
    return typed == History::kMain ? say(typed) : m_withheld.name(typed, "approach");
  }

  std::string sideName() const
  {
    switch (m_value.description.side)
    {
    case scene::Side::Left:
      return say("left");
    case scene::Side::Right:
      return say("right");
    case scene::Side::Both:
      return say("both sides");
    case scene::Side::Unknown:
      break;
    }
    return say("not stated");
  }

  // "Case 3F2A90C1": of the case's random id, which says nothing of anybody.
  std::string caseName()
  {
    const std::string typed = m_withheld.line(m_value.name);
    if (!typed.empty())
      return typed;
    std::string code = m_value.id.substr(0, 8);
    for (char& c : code)
      c = c >= 'a' && c <= 'f' ? static_cast<char>(c - 'a' + 'A') : c;
    return say("Case") + (code.empty() ? "" : " " + code);
  }

  void addHead()
  {
    const scene::Description& description = m_value.description;
    m_report.language = m_options.language;
    m_report.title = say("Operation plan");
    m_report.name = caseName();
    m_report.side = say(sideText(description.side));
    m_report.pageOf = say("Page %1 of %2");
    m_report.stamp = m_report.name + "  ·  " + m_report.side;
    m_report.colophon =
        "Petrous" + (m_options.version.empty() ? "" : " " + m_options.version) +
        (m_options.made.empty() ? "" : ", " + date(m_options.made)) + ". " +
        say("A plan, not a measurement of the patient: distances hold as far as the images and "
            "their registration do.");
    const auto fact = [this](const char* name, const std::string& text)
    {
      if (!text.empty())
        m_report.facts.emplace_back(say(name), text);
    };
    fact("Case", m_report.name);
    fact("Side", sideName());
    if (m_options.withDate && !description.date.empty())
    {
      fact("Planned for", date(description.date));
      m_report.stamp += "  ·  " + date(description.date);
      m_report.mayIdentify.emplace_back("the date of the planned operation: who has the list of "
                                        "that day's operations knows the patient by it");
    }
    fact("Diagnosis", m_withheld.line(description.diagnosis));
    fact("Procedure", m_withheld.line(description.procedure));
    const core::GridGeometry& grid = m_value.ct.geometry;
    fact("Image", std::string(primaryName(m_value)) + ", " + std::to_string(grid.dims()[0]) +
                      " x " + std::to_string(grid.dims()[1]) + " x " +
                      std::to_string(grid.dims()[2]) + ", " + voxelText(grid.spacing()));
    fact("Approach", m_approach);
    fact("Report of", date(m_options.made));
    if (m_options.keepIdentity)
    {
      fact("Note", m_value.description.note);
      m_report.mayIdentify.emplace_back("names and the note, as they were typed");
    }
  }

  std::string voxelText(const Vector3d& spacing) const
  {
    return number(spacing[0], 2) + " x " + number(spacing[1], 2) + " x " + number(spacing[2], 2) +
           " mm";
  }

  std::string textOf(const Quantity& quantity) const
  {
    std::string text = reportNumber(m_options.language, toString(quantity));
    for (const char* english : {"uncertainty unknown", "unknown"})
    {
      const std::string tail = english;
      if (text.size() >= tail.size() &&
          text.compare(text.size() - tail.size(), tail.size(), tail) == 0)
        return text.substr(0, text.size() - tail.size()) + say(tail);
    }
    return text;
  }

  ReportCell cellOf(const Quantity& quantity) const
  {
    ReportCell cell;
    cell.text = textOf(quantity);
    cell.value = quantity.value;
    cell.uncertainty = quantity.uncertainty;
    cell.isNumber = true;
    return cell;
  }

  ReportCell numberCell(double value, int decimals, const std::string& unit) const
  {
    ReportCell cell;
    cell.text = number(value, decimals) + (unit.empty() ? "" : " " + unit);
    cell.value = value;
    cell.isNumber = true;
    return cell;
  }

  std::string volumeText(double volume) const
  {
    return volume > 0.0 && volume < 0.005 ? "< " + number(0.01, 2) + " mm³"
                                          : number(volume, 2) + " mm³";
  }

  static ReportCell textCell(std::string text)
  {
    ReportCell cell;
    cell.text = std::move(text);
    return cell;
  }

  const appearance::StructureAppearance* lookOf(const std::string& structure) const
  {
    if (const auto* part = scene::findStructure(m_value, structure))
      return &part->look;
    for (const scene::MeshPart& mesh : m_value.meshes)
      if (mesh.name == structure)
        return &mesh.look;
    return nullptr;
  }

  bool isLumen(const std::string& structure) const
  {
    const auto* look = lookOf(structure);
    return look && !look->solid;
  }

  // A lumen is opened, which is no injury.
  bool isInjured(const DissectionDistance& one) const
  {
    return one.removed > 0.0 && !isLumen(one.name);
  }

  ReportCell structureCell(const std::string& name) const
  {
    ReportCell cell = textCell(name);
    if (const auto* look = lookOf(name))
      cell.color = look->color;
    return cell;
  }

  // Of a structure of which this paper says nothing but its name.
  struct Absent
  {
    std::string name, why;
    bool isDrawn = false;
  };

  std::string missingText(const scene::Placement& placement, bool isAmbiguous) const
  {
    if (isAmbiguous)
      return say("it is not stated on which MR it was drawn");
    return filled(say(scene::findMr(m_value, placement.drawnOn)
                          ? "drawn on the MR '%1', which is not registered"
                          : "drawn on the MR '%1', which is not in the case"),
                  placement.drawnOn);
  }

  std::vector<Absent> absentStructures() const
  {
    std::set<std::string> measured;
    for (const scene::StructureOccupancy& known : m_known)
      measured.insert(known.name);
    std::vector<Absent> absent;
    for (const scene::LabelPart& part : m_value.labels)
    {
      const scene::Placement placement = scene::placementOf(m_value, part);
      const bool isAmbiguous =
          !placement.missing.empty() && !part.drawnOn &&
          scene::mrWithGrid(m_value, part.labels.get()->voxels->geometry()).size() > 1;
      for (const scene::StructurePart& one : part.structures)
        if (measured.count(one.name) == 0)
          absent.push_back(
              {one.name, !placement.missing.empty() ? missingText(placement, isAmbiguous)
                         : one.voxels > 0 ? say("its data are missing or damaged in the library")
                                          : say("it has no voxels")});
    }
    for (const scene::MeshPart& mesh : m_value.meshes)
      if (measured.count(mesh.name) == 0)
      {
        const scene::Placement placement = scene::placementOf(m_value, mesh);
        const bool isDrawn = placement.missing.empty() && !mesh.mesh.get()->triangles.empty();
        absent.push_back({mesh.name,
                          !placement.missing.empty() ? missingText(placement, false)
                          : isDrawn ? say("a surface, which is not measured as a volume")
                                    : say("its data are missing or damaged in the library"),
                          isDrawn});
      }
    return absent;
  }

  // What else would read as if all structures were there.
  void addAbsent(ReportSection& table) const
  {
    if (m_absent.empty())
      return;
    for (const Absent& one : m_absent)
    {
      std::vector<ReportCell> row{structureCell(one.name), textCell(say("left out"))};
      row.back().isWarning = true;
      row.resize(table.table.columns.size());
      table.table.rows.push_back(std::move(row));
    }
    table.paragraphs.push_back(absentText(false));
  }

  std::string absentText(bool inPictures) const
  {
    std::string text;
    for (const Absent& one : m_absent)
      if (!inPictures || !one.isDrawn)
        text += (text.empty() ? say("Left out:") + " " : "; ") + shownName(one.name) + " (" +
                one.why + ")";
    return text;
  }

  rendering::SceneContents lit(rendering::SceneContents contents) const
  {
    illuminate(contents, m_value.view.light);
    return contents;
  }

  // With what lies within the bone: its own structures, and hidden ones that are warned of.
  scene::Case translucentCase() const
  {
    scene::Case value = m_value;
    const auto reveal = [](appearance::StructureAppearance& look)
    { look.shown = look.shown || look.warning > 0.0; };
    for (scene::LabelPart& part : value.labels)
      for (scene::StructurePart& structure : part.structures)
        reveal(structure.look);
    for (scene::MeshPart& mesh : value.meshes)
      reveal(mesh.look);
    if (!m_options.keepIdentity)
      value = thumbnailCase(std::move(value));
    appearance::applyPreset(value.boneLook,
                            appearance::StructurePresets::builtIn().preset("bone-translucent"));
    value.boneLook.sourceImage.clear();
    value.boneLook.shown = true;
    value.softTissue.shown = false;
    return value;
  }

  ReportPicture viewPicture(rendering::SceneContents contents, std::string caption,
                            const core::CameraPose& camera,
                            const scene::ViewState::Clipping& clipping,
                            const core::Progress& progress) const
  {
    const int width = m_options.pictureWidth;
    const int height = 3 * width / 4;
    clip(contents, clipping, m_value.ct.geometry);
    contents.background = m_options.background;
    const Backdrop backdrop = backdropOf(contents.background);
    rendering::ScenePicture scene;
    scene.setContents(contents);
    rendering::Picture picture = rendering::renderTiled(scene, camera, width, height, progress);
    const double magnified = width / 600.0;
    std::vector<std::string> lines{say(sideText(m_value.description.side))};
    for (const std::string& line : clippingTexts(clipping, m_value.ct.geometry))
      lines.push_back(say(line));
    addLines(picture, lines, magnified, backdrop);
    addEdgeLetters(picture, camera, magnified, backdrop);
    addScaleBar(picture, rendering::millimetresPerPixel(camera, height),
                camera.parallelScale ? "" : say("in the focal plane"), magnified, backdrop);
    for (std::size_t n = 1; n < lines.size(); ++n)
      caption += " (" + lines[n] + ")";
    return reportPicture(std::move(caption), picture, 2);
  }

  // As the case was saved, and as the surgeon has the patient. Without identity nothing in front of
  // bone is drawn by which a face could be recognised.
  void addViews(const core::Progress& progress)
  {
    ReportSection& views = section("views", say("Views"));
    if (std::string absent = absentText(true); !absent.empty())
      views.paragraphs.push_back(std::move(absent));
    const std::optional<scene::Side> ear = earOf(m_value);
    try
    {
      const scene::Case shown = m_options.keepIdentity ? m_value : thumbnailCase(m_value);
      const rendering::SceneContents opaque = lit(sceneContents(shown, progress.part(0.0, 0.2)));
      if (!opaque.boneShown && opaque.meshes.empty() && opaque.materials.size() < 2 &&
          !opaque.softTissue)
      {
        views.paragraphs.push_back(say("Nothing of the case is shown in 3D."));
        return;
      }
      std::optional<rendering::SceneContents> translucent;
      if (m_value.ct.modality != scene::Modality::Mr)
      {
        constexpr double kEdges = 0.7; // by which translucent bone keeps its shape
        translucent = lit(sceneContents(translucentCase(), progress.part(0.2, 0.4)));
        translucent->light.edges = std::max(translucent->light.edges, kEdges);
      }
      const auto add = [&](const std::string& caption, const core::CameraPose& camera,
                           const scene::ViewState::Clipping& clipping, const core::Progress& part)
      {
        views.pictures.push_back(
            viewPicture(opaque, caption, camera, clipping, part.part(0.0, 0.5)));
        if (translucent)
          views.pictures.push_back(viewPicture(*translucent,
                                               caption + ", " + say("bone made translucent"),
                                               camera, clipping, part.part(0.5, 1.0)));
      };
      add(say(firstCaption()), currentCamera(m_value), m_value.view.clipping,
          progress.part(0.4, 0.7));
      if (ear)
        add(say(surgicalCaption()),
            standardCamera(m_value, ear == scene::Side::Left
                                        ? rendering::StandardView::SurgicalLeft
                                        : rendering::StandardView::SurgicalRight),
            {}, progress.part(0.7, 1.0));
      else
        views.paragraphs.push_back(
            say("The surgical position is not shown, as the case does not tell which ear it is."));
    }
    catch (const rendering::RenderingError& error)
    {
      if (error.reason != rendering::RenderingError::Reason::NoOpenGL)
        throw;
      views.paragraphs.push_back(
          say("There are no 3D pictures: OpenGL is missing on this computer."));
    }
  }

  // Of the view that currentCamera takes.
  const char* firstCaption() const
  {
    if (m_value.camera)
      return "3D view as saved";
    const std::optional<scene::Side> guessed = guessedEar(m_value);
    if (!guessed)
      return "Lateral view";
    return guessed == scene::Side::Left ? "Lateral view from the patient's left; the case does not "
                                          "tell which ear it is"
                                        : "Lateral view from the patient's right; the case does "
                                          "not tell which ear it is";
  }

  // No ear is named that nobody stated.
  const char* surgicalCaption() const
  {
    switch (m_value.description.side)
    {
    case scene::Side::Left:
      return "Surgical position, left ear";
    case scene::Side::Right:
      return "Surgical position, right ear";
    default:
      return "Surgical position; the side is taken from where the image lies";
    }
  }

  void addDistances(const std::vector<DissectionDistance>& distances)
  {
    ReportSection& table = section("distances", say("Distances of the dissection"));
    if (m_value.dissection.mask().untouched())
    {
      table.paragraphs.push_back(say("Nothing was drilled on this approach."));
      return;
    }
    if (distances.empty() && m_absent.empty())
    {
      table.paragraphs.push_back(say("The case has no structures to measure to."));
      return;
    }
    table.table.columns = {say("Structure"), say("Distance"), say("Removed from it")};
    for (const DissectionDistance& one : distances)
    {
      ReportCell distance = cellOf(one.distance);
      if (*one.distance.value <= 0.0)
      {
        distance.text = say("reached");
        distance.isWarning = isInjured(one);
      }
      ReportCell removed = numberCell(one.removed, 2, "mm³");
      removed.isWarning = isInjured(one);
      removed.text = one.removed > 0.0 ? volumeText(one.removed) : say("nothing");
      table.table.rows.push_back({structureCell(one.name), distance, removed});
    }
    addGuesses(table);
    if (const std::string repairs =
            joined(repairsOf(m_value.ct.provenance, m_value.ct.geometry.dims()[2]));
        !repairs.empty())
      table.paragraphs.push_back(
          filled(say("Guessed at import of the %1, and distances with it"), primaryName(m_value)) +
          ": " + repairs + ".");
    addAbsent(table);
    table.remarks.push_back(
        say("Shortest distance between what was removed and the surface of each "
            "structure, nearest first. ± is a half-width: half a voxel of structure and wall, and "
            "the error of the registration where a structure was drawn on an MR."));
    addOwnNotes(table);
  }

  // What of the structure's geometry nobody measured or drew, a phrase each.
  std::vector<std::string> guessesOf(const std::string& structure) const
  {
    std::vector<std::string> texts;
    for (const scene::LabelPart& part : m_value.labels)
      for (const scene::StructurePart& one : part.structures)
        if (one.name == structure)
        {
          texts = placeGuessesOf(part);
          addTubes(one.tubes, texts);
        }
    for (const scene::StructureOccupancy& known : m_known)
      if (known.name == structure)
        addInterpolated(known, texts);
    return texts;
  }

  void addTubes(const scene::TracedTubes& tubes, std::vector<std::string>& texts) const
  {
    constexpr double kLeast = 0.05; // of the length: as the window warns
    if (tubes.unresolved > 0.0 && tubes.unresolved >= kLeast * tubes.length)
      texts.push_back(
          filled(say("traced between points alone along %1 of %2 mm, as the image does not "
                     "resolve it there"),
                 number(tubes.unresolved, 1), number(tubes.length, 1)));
    if (tubes.bridging > 0)
      texts.push_back(filled(say("thinner than the voxels, and drawn one voxel wide in %1 of them"),
                             std::to_string(tubes.bridging)));
  }

  // Slices of an image into which a structure reaches, that repair interpolated. Patient LPS, mm.
  static std::vector<volume::SliceRange> interpolatedIn(const scene::ImagePart& image,
                                                        const core::RigidTransform& imageFromCt,
                                                        const core::GridGeometry& around)
  {
    constexpr double kMargin = 1.0; // voxels, of `around` beyond the structure's own
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (int corner = 0; corner < 8; ++corner)
    {
      Vector3d voxel;
      for (std::size_t axis = 0; axis < 3; ++axis)
        voxel[static_cast<Eigen::Index>(axis)] =
            (corner >> axis & 1) != 0 ? around.dims()[axis] - 1 - kMargin : kMargin;
      const double slice =
          image.geometry.voxelFromPatient(imageFromCt * around.patientFromVoxel(voxel))[2];
      first = std::min(first, slice);
      last = std::max(last, slice);
    }
    std::vector<volume::SliceRange> found;
    for (const volume::SliceRange& range : image.provenance.interpolated)
    {
      const volume::SliceRange shared{std::max(range.first, static_cast<int>(std::lround(first))),
                                      std::min(range.last, static_cast<int>(std::lround(last)))};
      if (shared.first <= shared.last)
        found.push_back(shared);
    }
    return found;
  }

  // Of the images on which it was drawn, or from which it was made.
  void addInterpolated(const scene::StructureOccupancy& known,
                       std::vector<std::string>& texts) const
  {
    const auto add = [&](const scene::ImagePart& image, const core::RigidTransform& imageFromCt,
                         const std::string& name)
    {
      const auto slices = interpolatedIn(image, imageFromCt, known.around);
      if (!slices.empty())
        texts.push_back(filled(say("slices %1 of %2, in which it lies, are interpolated"),
                               volume::toString(slices), name));
    };
    const scene::ImagePart* mr = scene::findMr(m_value, known.mr);
    if (mr)
      add(*mr, mr->mrFromCt, mr->name);
    for (const scene::MrReading& reading : known.readings)
      if (const auto* source = reading.isGone ? nullptr : scene::findMr(m_value, reading.mr))
        add(*source, reading.mrFromCt, source->name);
    if (!mr && known.readings.empty())
      add(m_value.ct, core::RigidTransform(), primaryName(m_value));
  }

  static std::string joined(const std::vector<std::string>& texts)
  {
    std::string all;
    for (const std::string& text : texts)
      all += (all.empty() ? "" : "; ") + text;
    return all;
  }

  std::string withGuesses(std::string remark, const std::string& structure) const
  {
    const std::string guesses = structure.empty() ? std::string() : joined(guessesOf(structure));
    if (guesses.empty())
      return remark;
    return remark + (remark.empty() ? "" : "; ") + say("guessed:") + " " + guesses;
  }

  // A column beside the numbers, where any of the structures has guesses.
  void addGuesses(ReportSection& table) const
  {
    std::vector<std::string> texts;
    for (const auto& row : table.table.rows)
      texts.push_back(joined(guessesOf(row.front().text)));
    if (std::all_of(texts.begin(), texts.end(), [](const auto& text) { return text.empty(); }))
      return;
    table.table.columns.push_back(say("Guessed"));
    for (std::size_t n = 0; n < texts.size(); ++n)
    {
      table.table.rows[n].push_back(textCell(texts[n]));
      table.table.rows[n].back().isWarning = !texts[n].empty();
    }
  }

  // The notes of the import that are of a structure alone, as they name it, or with its name. What
  // a file's note says of all that it has stands with what was assumed.
  std::vector<std::string> ownNotes(const std::string& structure) const
  {
    std::vector<std::string> texts;
    const auto add = [&](const std::string& note, bool isAlone)
    {
      const bool isNamed = m_withheld.sentence(note).find("'" + structure + "'") != note.npos;
      if (isNamed || isAlone)
        texts.push_back((isNamed ? "" : shownName(structure) + ": ") + noteText(note));
    };
    for (const scene::LabelPart& part : m_value.labels)
      for (const scene::StructurePart& one : part.structures)
        if (one.name == structure)
        {
          for (const std::string& note : part.notes)
            add(note, part.structures.size() == 1);
          return texts;
        }
    for (const scene::MeshPart& mesh : m_value.meshes)
      if (mesh.name == structure)
        for (const std::string& note : mesh.notes)
          add(note, true);
    return texts;
  }

  void addOwnNotes(ReportSection& table) const
  {
    for (const auto& row : table.table.rows)
    {
      const auto notes = ownNotes(row.front().text);
      table.remarks.insert(table.remarks.end(), notes.begin(), notes.end());
    }
  }

  // Those of which slices are drawn, injured ones first, then guarded ones, each nearest first. A
  // lumen that is not warned of is opened, and no danger.
  std::vector<DissectionDistance> critical(const std::vector<DissectionDistance>& distances) const
  {
    constexpr double kNear = 5.0; // mm: of structures that are not guarded
    std::vector<DissectionDistance> found;
    for (const DissectionDistance& one : distances)
      if (isInjured(one) || isGuarded(one.name) ||
          (*one.distance.value <= kNear && !isLumen(one.name)))
        found.push_back(one);
    const auto rank = [this](const DissectionDistance& one) {
      return isInjured(one) ? 0 : isGuarded(one.name) ? 1 : 2;
    };
    std::stable_sort(found.begin(), found.end(),
                     [&rank](const DissectionDistance& a, const DissectionDistance& b)
                     { return rank(a) < rank(b); });
    return found;
  }

  // Whether a burr is warned of it or kept from it.
  bool isGuarded(const std::string& structure) const
  {
    const auto* look = lookOf(structure);
    return look && (look->warning > 0.0 || (look->solid && !look->drillable));
  }

  std::string nearestText(const DissectionDistance& one) const
  {
    std::string text = shownName(one.name) + ": " +
                       (*one.distance.value > 0.0 ? textOf(one.distance) : say("reached"));
    if (one.removed > 0.0)
      text += ", " + say("Removed from it") + ": " + volumeText(one.removed);
    return withGuesses(text, one.name);
  }

  // Hidden ones, too, of those that are reported.
  scene::Case withShown(const std::vector<DissectionDistance>& reported) const
  {
    scene::Case value = m_value;
    for (const DissectionDistance& one : reported)
    {
      for (scene::LabelPart& part : value.labels)
        for (scene::StructurePart& structure : part.structures)
          structure.look.shown = structure.look.shown || structure.name == one.name;
      for (scene::MeshPart& mesh : value.meshes)
        mesh.look.shown = mesh.look.shown || mesh.name == one.name;
    }
    return value;
  }

  rendering::Picture slicePicture(const SlicePresenter& presenter, const SliceGeometry& slice,
                                  const char* name) const
  {
    std::vector<std::string> lines{say(name)};
    if (showsInterpolated(m_value.ct, slice))
      lines.push_back(say("interpolated slice: not measured here"));
    return labelledSlice(presenter.draw(slice, displayOf(m_value).bone), slice, lines);
  }

  static ReportPicture reportPicture(std::string caption, const rendering::Picture& picture,
                                     int inRow)
  {
    return {std::move(caption), rendering::pngOf(picture), picture.width, picture.height, inRow};
  }

  // The three slices through a place, which a cross marks.
  void addSlices(ReportSection& section, const SlicePresenter& presenter, const Vector3d& place,
                 double fieldOfView, int inRow) const
  {
    const int width = m_options.sliceWidth;
    for (const SliceOrientation orientation :
         {SliceOrientation::Axial, SliceOrientation::Coronal, SliceOrientation::Sagittal})
    {
      const SliceGeometry slice(orientation, place, fieldOfView / width, width, width);
      rendering::Picture picture = slicePicture(presenter, slice, nameOf(orientation));
      addCross(picture, slice.pixelFromPatient(place));
      section.pictures.push_back(reportPicture(say(nameOf(orientation)), picture, inRow));
    }
  }

  // The plane that has the distance in it, turned as little as can be from a standard slice.
  void addAlong(ReportSection& section, const SlicePresenter& presenter,
                const DissectionDistance& one, double fieldOfView, int inRow) const
  {
    const Vector3d way = (one.onStructure - one.place).normalized();
    Vector3d normal = Vector3d::Zero();
    for (const SliceOrientation orientation :
         {SliceOrientation::Axial, SliceOrientation::Coronal, SliceOrientation::Sagittal})
    {
      const Vector3d next = axesOf(orientation).next;
      if (const Vector3d across = next - next.dot(way) * way; across.norm() > normal.norm())
        normal = across;
    }
    const ObliquePlane plane = planeWithNormal(normal);
    const int width = m_options.sliceWidth;
    const SliceGeometry slice(plane.orientation, plane.axes, 0.5 * (one.place + one.onStructure),
                              fieldOfView / width, width, width);
    const char* name = "Along the distance";
    rendering::Picture picture = slicePicture(presenter, slice, name);
    addLine(picture, slice.pixelFromPatient(one.place), slice.pixelFromPatient(one.onStructure));
    section.pictures.push_back(reportPicture(say(name), picture, inRow));
  }

  // Slices where the dissection came nearest to what it must not injure.
  void addNearest(const std::vector<DissectionDistance>& distances, const core::Progress& progress)
  {
    ReportSection& pictures = section("nearest", say("Nearest to structures"));
    if (m_value.dissection.mask().untouched())
    {
      pictures.paragraphs.push_back(say("Nothing was drilled on this approach."));
      return;
    }
    std::vector<DissectionDistance> near;
    std::string far, others;
    for (DissectionDistance& one : critical(distances))
    {
      std::string* left = *one.distance.value > kTooFar    ? &far
                          : near.size() == kMostStructures ? &others
                                                           : nullptr;
      if (left)
        *left += (left->empty() ? "" : ", ") + shownName(one.name);
      else
        near.push_back(std::move(one));
    }
    pictures.paragraphs.push_back(
        say(near.empty() ? "The dissection comes near no structure that is warned of or kept from "
                           "the drill."
                         : "Each row has slices through the place of the cavity, marked by the "
                           "cross, that is nearest to a structure. Structures are tinted and "
                           "outlined, what was drilled is red and hatched; the line is the "
                           "distance, in a plane that contains it."));
    if (!far.empty())
      pictures.paragraphs.push_back(
          filled(say("Farther than %1 mm, and without slices: %2."), number(kTooFar, 0), far));
    if (!others.empty())
      pictures.paragraphs.push_back(filled(say("Only the first %1 have slices; without are: %2."),
                                           std::to_string(kMostStructures), others));
    const SlicePresenter presenter(withShown(near));
    std::size_t done = 0;
    for (const DissectionDistance& one : near)
    {
      progress.report(static_cast<double>(done++) / static_cast<double>(near.size()),
                      "drawing slices");
      constexpr double kLeast = 40.0; // mm
      constexpr int kInRow = 4;
      const double fieldOfView = std::max(kLeast, 3.0 * *one.distance.value);
      const std::size_t first = pictures.pictures.size();
      addSlices(pictures, presenter, one.place, fieldOfView, kInRow);
      if (*one.distance.value > 0.0)
        addAlong(pictures, presenter, one, fieldOfView, kInRow);
      pictures.pictures[first].heading = nearestText(one);
    }
  }

  // The marks; of a case that has neither marks nor a cavity the crosshair.
  void addPlaces(const core::Progress& progress)
  {
    struct Place
    {
      std::string name;
      Vector3d point;
    };
    std::vector<Place> places;
    std::size_t marks = 0;
    for (const scene::Measurement& one : m_value.measurements)
      if (one.kind == scene::Measurement::Kind::Mark && marks++ < kMostPlaces)
        places.push_back({say("mark") + " “" + one.name + "”", one.points.front()});
    if (places.empty() && !m_report.sections.back().pictures.empty())
      return;
    if (places.empty())
      places.push_back({say("crosshair"), m_value.view.slices ? m_value.view.slices->crosshair
                                                              : m_value.ct.geometry.center()});
    ReportSection& pictures = section("places", say("Key places"));
    pictures.paragraphs.push_back(
        say("Each row has the three slices through a place, which the yellow cross marks."));
    if (marks > kMostPlaces)
      pictures.remarks.push_back(filled(say("Only the first %1 of %2 are listed."),
                                        std::to_string(kMostPlaces), std::to_string(marks)));
    const SlicePresenter presenter(m_value);
    std::size_t done = 0;
    for (const Place& place : places)
    {
      constexpr double kFieldOfView = 40.0; // mm
      progress.report(static_cast<double>(done++) / static_cast<double>(places.size()),
                      "drawing slices");
      const std::size_t first = pictures.pictures.size();
      addSlices(pictures, presenter, place.point, kFieldOfView, 3);
      pictures.pictures[first].heading = place.name;
    }
  }

  std::string touchedText(const std::vector<dissection::TouchedStructure>& touched)
  {
    std::string text;
    for (const dissection::TouchedStructure& one : touched)
      text += (text.empty() ? "" : ", ") + shownName(m_withheld.name(one.name, "structure")) + " " +
              volumeText(one.volume);
    return text;
  }

  void addApproaches()
  {
    const History& history = m_value.dissection.history();
    ReportSection& table = section("approaches", say("Approaches"));
    if (m_value.dissection.strokes().empty())
    {
      table.paragraphs.push_back(say("Nothing was drilled yet."));
      return;
    }
    table.table.columns = {say("Approach"), say("Strokes"), say("Drilling time"), say("Removed"),
                           say("Of structures")};
    for (const History::Branch& branch : history.branches())
    {
      const scene::StateSummary summary = scene::summaryOf(m_value, branch.position);
      const bool isThis = &branch == &history.branch();
      table.table.rows.push_back(
          {textCell(approachName(branch.name) + (isThis ? " (" + say("reported here") + ")" : "")),
           numberCell(static_cast<double>(summary.strokes), 0, ""),
           numberCell(summary.duration, 1, "s"), numberCell(summary.removed, 1, "mm³"),
           textCell(touchedText(summary.structures))});
    }
  }

  void addStrokes()
  {
    const History& history = m_value.dissection.history();
    const auto line = history.lineTo(history.position());
    if (line.empty())
      return;
    ReportSection& table = section("strokes", say("Strokes") + ": " + m_approach);
    const auto& strokes = m_value.dissection.strokes();
    const bool isByPedal =
        std::any_of(line.begin(), line.end(),
                    [&strokes](std::size_t n) { return strokes[n]->info.speed.has_value(); });
    table.table.columns = {say("Stroke"), say("Burr"), say("Set speed")};
    if (isByPedal)
      for (const char* column : {"Mean speed", "Highest speed"})
        table.table.columns.push_back(say(column));
    for (const char* column : {"Time", "Removed", "Of structures"})
      table.table.columns.push_back(say(column));
    const auto addRow =
        [&](std::vector<ReportCell> row, const std::optional<dissection::SpindleSpeed>& speed)
    {
      const std::vector<ReportCell> cells{speed ? numberCell(speed->mean, 0, "/min") : textCell({}),
                                          speed ? numberCell(speed->max, 0, "/min") : textCell({})};
      if (isByPedal)
        row.insert(row.begin() + 3, cells.begin(), cells.end());
      table.table.rows.push_back(std::move(row));
    };
    for (const std::size_t n : line)
    {
      if (table.table.rows.size() == kMostRows)
      {
        table.remarks.push_back(filled(say("Only the first %1 of %2 are listed."),
                                       std::to_string(kMostRows), std::to_string(line.size())));
        break;
      }
      const dissection::StrokeInfo& info = strokes[n]->info;
      addRow(
          {numberCell(static_cast<double>(dissection::strokeNumber(n)), 0, ""),
           textCell(number(info.burr.diameter, 1) + " mm, " + say(dissection::nameOf(info.burr))),
           numberCell(info.burr.rpm, 0, "/min"), numberCell(info.duration, 1, "s"),
           numberCell(info.removed, 2, "mm³"), textCell(touchedText(info.structures))},
          info.speed);
    }
    const scene::StateSummary summary = scene::summaryOf(m_value, history.position());
    addRow({textCell(say("All together")), textCell({}), textCell({}),
            numberCell(summary.duration, 1, "s"), numberCell(summary.removed, 2, "mm³"),
            textCell({})},
           std::nullopt);
    table.table.rows.back()[0].isNumber = true;
  }

  void addMeasurements()
  {
    ReportSection& table = section("measurements", say("Measurements and marks"));
    if (m_value.measurements.empty())
    {
      table.paragraphs.push_back(say("Nothing was measured or marked."));
      return;
    }
    table.table.columns = {say("Name"), say("Quantity"), say("Value"), say("Remark")};
    for (const scene::Measurement& one : m_value.measurements)
      for (const Quantity& quantity : quantitiesOf(m_value, one))
      {
        if (table.table.rows.size() >= kMostRows)
        {
          table.remarks.assign(1, filled(say("Only the first %1 of %2 are listed."),
                                         std::to_string(kMostRows),
                                         std::to_string(m_value.measurements.size())));
          return;
        }
        const bool isMark = one.kind == scene::Measurement::Kind::Mark;
        table.table.rows.push_back(
            {textCell(one.name), textCell((isMark ? say("mark") + ", " : "") + say(quantity.name)),
             cellOf(quantity), textCell(withGuesses(say(quantity.remark), one.structure))});
      }
  }

  void addStructures(const core::Progress& progress)
  {
    ReportSection& table = section("structures", say("Structures"));
    if (m_known.empty() && m_absent.empty())
    {
      table.paragraphs.push_back(say("The case has no structures."));
      return;
    }
    table.table.columns = {say("Structure"),  say("Volume"),   say("Thickness"),
                           say("Voxel edge"), say("Resolved"), say("Drawn on")};
    std::size_t done = 0;
    for (const scene::StructureOccupancy& known : m_known)
    {
      const double share = static_cast<double>(done++) / static_cast<double>(m_known.size());
      progress.report(share, "measuring structures");
      std::vector<ReportCell> row{structureCell(known.name)};
      const Vector3d voxel = known.grid.spacing();
      std::optional<Quantity> volume, thickness;
      try
      {
        for (const Quantity& one :
             dimensionsOf(m_value, known.name,
                          progress.part(share, static_cast<double>(done) /
                                                   static_cast<double>(m_known.size()))))
          if (one.name == "volume")
            volume = one;
          else if ((one.name == "largest thickness" || one.name == "smallest diameter") &&
                   one.value && (!thickness || *one.value < *thickness->value))
            thickness = one;
      }
      catch (const core::InvalidParameter&) // it encloses nothing
      {
      }
      row.push_back(volume ? cellOf(*volume) : textCell(say("unknown")));
      row.push_back(thickness ? cellOf(*thickness) : textCell(say("unknown")));
      row.push_back(numberCell(voxel.maxCoeff(), 2, "mm"));
      if (voxel.minCoeff() < voxel.maxCoeff() - 0.005)
        row.back().text = number(voxel.minCoeff(), 2) + "–" + row.back().text;
      constexpr double kLargestShare = 0.5; // of the volume, that is uncertain
      const bool isVolumeKnown =
          volume && volume->value &&
          volume->uncertainty.value_or(0.0) <= kLargestShare * *volume->value;
      const bool isResolved =
          thickness && *thickness->value >= 2.0 * voxel.maxCoeff() && isVolumeKnown;
      row.push_back(textCell(say(isResolved ? "yes" : "no")));
      row.back().isWarning = !isResolved;
      std::string drawnOn = known.mr.empty() ? primaryName(m_value) : known.mr;
      if (!known.readings.empty())
        drawnOn += ", " + filled(say("made from the MR %1"), scene::namesOf(known.readings));
      const bool isOutdated = !scene::outdatedReading(m_value, known.readings).empty();
      if (isOutdated)
        drawnOn += ", " + say("which lies elsewhere since: error unknown");
      row.push_back(textCell(drawnOn));
      row.back().isWarning = isOutdated;
      table.table.rows.push_back(std::move(row));
    }
    addGuesses(table);
    addAbsent(table);
    table.remarks.push_back(
        say("Thickness: of the largest ball that fits inside, or of a tube at its narrowest. "
            "Resolved: this is two voxels or more, and its volume is known to a half. Of what is "
            "not, volume and distances say little; thin parts of what is may be missing."));
    addOwnNotes(table);
  }

  std::string methodText(const scene::Registration& how) const
  {
    using Method = scene::Registration::Method;
    std::string text = say(how.method == Method::MutualInformation ? "mutual information"
                           : how.method == Method::Landmarks       ? "landmarks"
                           : how.isFromFile                        ? "transform of a file"
                           : how.method == Method::ByHand          ? "by hand"
                                                                   : "frame of reference");
    if (how.refined)
      text += say(", refined by mutual information");
    if (!how.through.empty())
      text += say(", through ") + how.through;
    return text;
  }

  void addRegistrations()
  {
    ReportSection& table = section("registration", say("Registration"));
    if (m_value.mr.empty())
    {
      table.paragraphs.push_back(say("The case has no MR beside its primary image."));
      return;
    }
    table.table.columns = {say("Image"), say("Verdict"), say("Method"), say("Error, median"),
                           say("95 %"),  say("largest"), say("At"),     say("Signed off")};
    for (const scene::ImagePart& mr : m_value.mr)
    {
      std::vector<ReportCell> row{textCell(mr.name)};
      if (!mr.registered || !mr.registration)
      {
        row.push_back(textCell(say("not registered")));
        row.back().isWarning = true;
        row.resize(table.table.columns.size());
        table.table.rows.push_back(std::move(row));
        continue;
      }
      const scene::Registration& how = *mr.registration;
      row.push_back(textCell(say(nameOf(how.verdict))));
      row.back().isWarning = how.verdict == scene::Registration::Verdict::Doubtful;
      row.push_back(textCell(methodText(how)));
      for (const double scene::RegistrationError::*which :
           {&scene::RegistrationError::median, &scene::RegistrationError::p95,
            &scene::RegistrationError::max})
        row.push_back(how.error ? numberCell((*how.error).*which, 2, "mm")
                                : textCell(say("unknown")));
      row.push_back(textCell(how.error ? say(how.error->place) : ""));
      const scene::SignOff* signOff = scene::validSignOff(mr);
      const bool names = signOff && m_options.keepIdentity && !signOff->who.empty();
      row.push_back(textCell(names     ? say("yes, by ") + signOff->who
                             : signOff ? say("yes")
                                       : say("no")));
      table.table.rows.push_back(std::move(row));
      if (!how.text.empty())
        table.remarks.push_back(mr.name + ": " + say(how.text));
    }
  }

  std::vector<std::string> repairsOf(const volume::ImageProvenance& provenance, int slices) const
  {
    std::vector<std::string> texts;
    if (!provenance.interpolated.empty())
      texts.push_back(filled(say("slices %1 of %2 interpolated between neighbours"),
                             volume::toString(provenance.interpolated), std::to_string(slices)));
    if (provenance.tilt != 0.0)
      texts.push_back(filled(say("gantry tilt of %1 degrees undone, slices shifted by up to %2 mm"),
                             number(provenance.tilt, 1), number(provenance.shift, 1)));
    else if (provenance.shift != 0.0)
      texts.push_back(
          filled(say("slices shifted sideways by up to %1 mm"), number(provenance.shift, 2)));
    return texts;
  }

  std::vector<std::string> assumptionsOf(const volume::ImageProvenance& provenance,
                                         int slices) const
  {
    std::vector<std::string> texts = repairsOf(provenance, slices);
    if (provenance.isFaceMasked)
      texts.push_back(say(provenance.areEarsMasked ? "face and auricles masked" : "face masked"));
    if (provenance.isCropped)
      texts.push_back(say("cropped to a region"));
    for (const std::string& text : axesTexts(provenance.assumedRas, provenance.axes))
      texts.push_back(say(text));
    if (provenance.pixels.isLossy)
      texts.push_back(say("compressed with loss") +
                      (provenance.pixels.lossyRatio
                           ? " (1/" + number(*provenance.pixels.lossyRatio, 1) + ")"
                           : ""));
    if (provenance.pixels.burnedIn != volume::BurnedInText::None)
      texts.push_back(say(provenance.pixels.burnedIn == volume::BurnedInText::Stated
                              ? "text in the pixels"
                              : "perhaps text in the pixels"));
    return texts;
  }

  std::vector<std::string> placeGuessesOf(const scene::LabelPart& part) const
  {
    std::vector<std::string> texts = provenanceTexts(part);
    for (std::string& text : texts)
      text = say(text);
    return texts;
  }

  std::string noteText(const std::string& note) const
  {
    return note.empty() ? say("a note") + " (" + say("withheld") + ")"
                        : say(m_withheld.sentence(note));
  }

  void addAssumptions()
  {
    ReportSection& table = section("import", say("Assumed at import"));
    const auto add = [&](const std::string& name, const std::vector<std::string>& texts)
    {
      for (const std::string& text : texts)
        table.table.rows.push_back({textCell(name), textCell(text)});
    };
    const auto notesOf = [this](const std::vector<std::string>& notes)
    {
      std::vector<std::string> texts;
      for (const std::string& note : notes)
        texts.push_back(noteText(note));
      return texts;
    };
    const auto addImage = [&](const std::string& name, const scene::ImagePart& image)
    {
      add(name, assumptionsOf(image.provenance, image.geometry.dims()[2]));
      add(name, notesOf(image.notes));
    };
    addImage(primaryName(m_value), m_value.ct);
    for (const scene::ImagePart& mr : m_value.mr)
      addImage(mr.name, mr);
    for (const scene::LabelPart& part : m_value.labels)
    {
      std::string names;
      for (const scene::StructurePart& one : part.structures)
        names += (names.empty() ? "" : ", ") + one.name;
      add(names, placeGuessesOf(part));
      add(names, notesOf(part.notes));
    }
    for (const scene::MeshPart& mesh : m_value.meshes)
      add(mesh.name, notesOf(mesh.notes));
    if (table.table.rows.empty())
      table.paragraphs.push_back(
          say("Nothing: images and structures are as their files have them."));
    else
      table.table.columns = {say("Image"), say("What")};
  }

  void finish()
  {
    if (m_value.description.side == scene::Side::Unknown)
      m_report.sections.front().paragraphs.insert(
          m_report.sections.front().paragraphs.begin(),
          say("The side that is operated on is not stated."));
    if (!m_options.keepIdentity)
      m_report.keptTexts = m_withheld.keptTexts();
    if (!m_report.keptTexts.empty())
      m_report.mayIdentify.push_back("texts as they were typed, in which nobody was recognised: " +
                                     m_report.keptTexts + "; read them yourself");
  }

  scene::Case m_value;
  const ReportOptions& m_options;
  Withheld m_withheld;
  std::string m_approach;
  std::vector<scene::StructureOccupancy> m_known;
  std::vector<Absent> m_absent;
  PlanReport m_report;
};

} // namespace

PlanReport planReport(scene::Case value, const ReportOptions& options,
                      const core::Progress& progress)
{
  if (!value.dissection.loaded())
    throw core::InvalidParameter("report: the dissection of case '" + value.name +
                                 "' is not loaded");
  return Assembly(std::move(value), options).make(progress);
}

} // namespace petrous::presenters
