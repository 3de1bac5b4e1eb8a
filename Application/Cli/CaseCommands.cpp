#include <algorithm>
#include <cmath>

#include "CaseJson.h"
#include "CaseWarnings.h"
#include "Commands.h"
#include "Numbers.h"
#include "PartNamed.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Imaging/DicomScan.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/StructureSet.h"
#include "petrous/Library/DerivedCache.h"
#include "petrous/Library/FrameSalt.h"
#include "petrous/Library/LibraryFiles.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/CorrectedCase.h"
#include "petrous/Presenters/IntensityDisplay.h"
#include "petrous/Presenters/NearbyStructures.h"
#include "petrous/Presenters/PartFiles.h"
#include "petrous/Presenters/ProvenanceText.h"
#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/ExposedSurfaces.h"
#include "petrous/Scene/Placement.h"

namespace petrous::cli
{

namespace
{

// DICOM states its lengths in millimetres, and no option says otherwise.
bool isDicomImage(const std::filesystem::path& path)
{
  std::error_code error;
  return std::filesystem::is_directory(path, error) ||
         (std::filesystem::exists(path, error) &&
          !imaging::isReadAs(path, imaging::kImage | imaging::kLabels));
}

bool isDicomLabels(const std::filesystem::path& path)
{
  std::error_code error;
  return std::filesystem::is_regular_file(path, error) &&
         (imaging::isDicomSegmentation(path) || imaging::isStructureSet(path));
}

// Whether there are parts, and each `isDicom`.
bool areAll(const std::vector<presenters::PartSource>& parts,
            bool (*isDicom)(const std::filesystem::path&))
{
  return !parts.empty() &&
         std::all_of(parts.begin(), parts.end(),
                     [isDicom](const presenters::PartSource& part) { return isDicom(part.path); });
}

struct PartOptions
{
  std::vector<std::string> mr;
  std::vector<std::string> labels;
  std::vector<std::string> meshes;
  std::string labelNames;
  std::string meshFrame;
  std::string meshUnit;
  bool meshParts = false;
  std::string mrFrame;
  std::string mrUnit;
  std::string labelsUnit;
  bool labelsAsTheyLie = false;
  std::string mrRoi;
  std::string labelsFrame;
  std::string mrAxes;
  std::string labelsAxes;
  std::string meshAxes;
  bool repair = false;
  std::string bits;
  bool otherPatient = false;
  bool skipTaken = false;
  bool renameTaken = false;
  std::vector<std::string> renamed;

  void addTo(CLI::App& command)
  {
    command
        .add_option("--mr", mr,
                    "MR: DICOM folder or image file; #UID: that series of the folder, "
                    "#UID#VOLUME: that volume of it")
        ->allow_extra_args(false)
        ->type_name("[NAME=]PATH[#UID[#VOLUME]]");
    command
        .add_option("--mr-frame", mrFrame,
                    "Axes of MR files that do not say which side is left: lps or ras")
        ->check(oneOf({"lps", "ras"}));
    command
        .add_option("--mr-axes", mrAxes,
                    "Corrects axes that MR files state wrongly: where that points which they call "
                    "left, posterior and superior, such as RPS")
        ->type_name("XYZ");
    command
        .add_option("--mr-roi", mrRoi,
                    "Part of each MR to load, in LPS mm of the MR as its own files place it")
        ->type_name("x0,x1,y0,y1,z0,z1");
    command.add_flag("--repair", repair,
                     "Resample tilted, uneven or gapped DICOM slices to a straight volume");
    command
        .add_option("--bits", bits,
                    "Of DICOM pixels with bits beside those stored that nothing explains: stored "
                    "leaves these out, allocated keeps them (else they are refused)")
        ->check(oneOf({"stored", "allocated"}));
    command.add_flag("--other-patient", otherPatient,
                     "Add an MR or structures whose files state another patient than the case's "
                     "images");
    command
        .add_option("--labels", labels,
                    "Structures: one a file, or one an index; a DICOM SEG or RT structure set; a "
                    "folder of masks; @MR: drawn on that MR")
        ->allow_extra_args(false)
        ->type_name("[NAME=]FILE[@MR]");
    command
        .add_option("--labels-frame", labelsFrame,
                    "Axes of label files that do not say which side is left, and do not have the "
                    "grid of an image of the case: lps or ras")
        ->check(oneOf({"lps", "ras"}));
    command
        .add_option("--labels-axes", labelsAxes,
                    "Likewise of label files, in place of the correction of their image and about "
                    "its centre (LPS: they lie where they belong)")
        ->type_name("XYZ");
    command.add_flag("--skip-taken", skipTaken,
                     "Of several structures leave out those whose names are in the case already");
    command.add_flag("--rename-taken", renameTaken,
                     "Structures and meshes whose names are in the case already get a number");
    command
        .add_option("--rename", renamed,
                    "A structure or mesh of the files that is OLD there is called NEW here")
        ->allow_extra_args(false)
        ->type_name("OLD=NEW");
    command
        .add_option("--label-names", labelNames,
                    "Names and colours of the indices: .ctbl, ITK-SNAP, CSV, TSV or JSON")
        ->type_name("TABLE");
    command
        .add_option("--mesh", meshes,
                    "Surface: OBJ, STL, PLY or VTP, mm LPS; @MR: of that MR's patient")
        ->allow_extra_args(false)
        ->type_name("[NAME=]FILE[@MR]");
    command
        .add_option("--mesh-frame", meshFrame,
                    "Coordinate system of the meshes: lps (DICOM, ITK) or ras (Slicer, NIfTI)")
        ->check(oneOf({"lps", "ras"}));
    command
        .add_option("--mesh-axes", meshAxes, "Likewise of meshes, about the centre of their image")
        ->type_name("XYZ");
    command.add_option("--mesh-unit", meshUnit, "Unit of the meshes: mm, cm, m, um or inch (mm)")
        ->check(oneOf({"mm", "cm", "m", "um", "inch"}));
    command.add_flag("--mesh-parts", meshParts,
                     "Of a mesh file with several objects (OBJ: o or g, text STL: solid) each is a "
                     "structure of its own, NAME before its name (else all are one)");
    command
        .add_option("--mr-unit", mrUnit,
                    "Unit of length of MR files of voxels, instead of what they state")
        ->check(oneOf({"mm", "cm", "m", "um", "nm", "inch"}));
    command
        .add_option("--labels-unit", labelsUnit,
                    "Unit of length of label files, instead of what they state")
        ->check(oneOf({"mm", "cm", "m", "um", "nm", "inch"}));
    command.add_flag("--labels-as-they-lie", labelsAsTheyLie,
                     "Add labels on another grid than a repaired CT where they lie");
  }

  presenters::PartSources sources() const
  {
    if (!labelNames.empty() && labels.empty())
      throw UsageError("--label-names goes with --labels");
    presenters::PartSources result;
    if (otherPatient && mr.empty() && labels.empty())
      throw UsageError("--other-patient goes with --mr or --labels");
    if (!mrFrame.empty() && mr.empty())
      throw UsageError("--mr-frame goes with --mr");
    if (!mrAxes.empty() && mr.empty())
      throw UsageError("--mr-axes goes with --mr");
    if (!labelsAxes.empty() && labels.empty())
      throw UsageError("--labels-axes goes with --labels");
    if (!meshAxes.empty() && meshes.empty())
      throw UsageError("--mesh-axes goes with --mesh");
    if (!mrUnit.empty() && mr.empty())
      throw UsageError("--mr-unit goes with --mr");
    if (!labelsUnit.empty() && labels.empty())
      throw UsageError("--labels-unit goes with --labels");
    if (labelsAsTheyLie && labels.empty())
      throw UsageError("--labels-as-they-lie goes with --labels");
    if (!mrRoi.empty() && mr.empty())
      throw UsageError("--mr-roi goes with --mr");
    if (meshParts && meshes.empty())
      throw UsageError("--mesh-parts goes with --mesh");
    if (skipTaken && labels.empty() && !meshParts)
      throw UsageError("--skip-taken goes with --labels or --mesh-parts");
    if (skipTaken && renameTaken)
      throw UsageError("--skip-taken and --rename-taken exclude each other");
    if ((renameTaken || !renamed.empty()) && labels.empty() && meshes.empty())
      throw UsageError("--rename-taken and --rename go with --labels or --mesh");
    std::map<std::string, std::string> newNames;
    for (const std::string& text : renamed)
    {
      const std::size_t at = text.find('=');
      if (at == std::string::npos || at == 0 || at + 1 == text.size())
        throw UsageError("--rename: give OLD=NEW, not '" + text + "'");
      newNames[text.substr(0, at)] = text.substr(at + 1);
    }
    if (!labelsFrame.empty() && labels.empty())
      throw UsageError("--labels-frame goes with --labels");
    for (const std::string& text : mr)
    {
      result.mr.push_back(presenters::PartSource::parseSeries(text));
      result.mr.back().repair = repair;
      result.mr.back().undeclaredBits = undeclaredBitsOf(bits);
      if (!mrFrame.empty())
        result.mr.back().assumeRas = mrFrame == "ras";
      if (!mrUnit.empty())
        result.mr.back().unit = millimetresOf(mrUnit);
      if (!mrAxes.empty())
        result.mr.back().axes = parseAxes(mrAxes, "--mr-axes");
      if (!mrRoi.empty())
        result.mr.back().roi = parseBox(mrRoi, "--mr-roi");
      result.mr.back().isOtherPatient = otherPatient;
    }
    for (const std::string& text : labels)
    {
      result.labels.push_back(presenters::PartSource::parseDrawn(text));
      if (!labelsFrame.empty())
        result.labels.back().assumeRas = labelsFrame == "ras";
      if (!labelsUnit.empty())
        result.labels.back().unit = millimetresOf(labelsUnit);
      if (!labelsAxes.empty())
        result.labels.back().axes = parseAxes(labelsAxes, "--labels-axes");
      result.labels.back().isOtherPatient = otherPatient;
      result.labels.back().asTheyLie = labelsAsTheyLie;
      result.labels.back().skipsTaken = skipTaken;
      result.labels.back().numbersTaken = renameTaken;
      result.labels.back().newNames = newNames;
    }
    if (!mrUnit.empty() && areAll(result.mr, isDicomImage))
      throw UsageError("--mr-unit goes with MR files of voxels; DICOM states its lengths in mm");
    if (!labelsUnit.empty() && areAll(result.labels, isDicomLabels))
      throw UsageError("--labels-unit goes with label files; DICOM states its lengths in mm");
    result.labelNames = labelNames;
    if (meshes.empty() && !(meshFrame.empty() && meshUnit.empty()))
      throw UsageError("--mesh-frame and --mesh-unit go with --mesh");
    for (const std::string& text : meshes)
    {
      result.meshes.push_back(presenters::PartSource::parseDrawn(text));
      result.meshes.back().isPerObject = meshParts;
      result.meshes.back().skipsTaken = skipTaken;
      result.meshes.back().numbersTaken = renameTaken;
      result.meshes.back().newNames = newNames;
      if (!meshFrame.empty())
        result.meshes.back().isRas = meshFrame == "ras";
      if (!meshUnit.empty())
        result.meshes.back().unit = millimetresOf(meshUnit);
      if (!meshAxes.empty())
        result.meshes.back().axes = parseAxes(meshAxes, "--mesh-axes");
    }
    return result;
  }
};

std::string sizeText(const core::GridGeometry& grid)
{
  const auto& n = grid.dims();
  const auto& h = grid.spacing();
  return std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " + std::to_string(n[2]) +
         " voxels of " + fixed(h[0], 3) + " x " + fixed(h[1], 3) + " x " + fixed(h[2], 3) + " mm";
}

void printCase(const Context& context, const scene::Case& value, const CaseFacts& facts)
{
  context.print("case '" + value.name + "'");
  if (const std::string line = descriptionLine(value.description); !line.empty())
    context.print("  " + line);
  if (!value.description.note.empty())
    context.print(indented(value.description.note));
  const presenters::IntensityDisplay display = presenters::displayOf(value);
  const bool isMr = value.ct.modality == scene::Modality::Mr;
  context.print((isMr ? "  MR as primary image " : "  CT ") + sizeText(value.ct.geometry) + ", " +
                display.number(value.ct.range.min) + " to " + display.text(value.ct.range.max) +
                (display.hounsfield ? "" : " (not in Hounsfield units)") + ", surface at " +
                display.text(value.iso));
  const auto printProvenance = [&context](const auto& part)
  {
    for (const std::string& text : presenters::provenanceTexts(part))
      context.print("    " + text);
  };
  printProvenance(value.ct);
  for (const auto& mr : value.mr)
  {
    context.print("  MR '" + mr.name + "' " + sizeText(mr.geometry) + ", " +
                  scene::registrationToString(mr));
    printProvenance(mr);
  }
  const auto errorText = [&facts](const std::string& structure)
  {
    const auto found = facts.registrationErrors.find(structure);
    return found != facts.registrationErrors.end() ? ", " + toString(found->second) : std::string();
  };
  const auto drilled = presenters::injuredVolumes(value);
  const auto drilledText = [&drilled](const std::string& structure)
  {
    const auto found = drilled.find(structure);
    return found != drilled.end() ? ", " + fixed(found->second, 2) + " mm3 drilled" : std::string();
  };
  for (const auto& part : value.labels)
    for (const auto& s : part.structures)
    {
      context.print("  structure '" + s.name + "', " + fixed(s.volume, 1) + " mm3" +
                    drilledText(s.name) + ", " + s.look.preset +
                    placeText(value, scene::placementOf(value, part)) +
                    madeText(value, s.readings) + errorText(s.name));
      printProvenance(part);
    }
  for (std::size_t n = 0; n < value.meshes.size(); ++n)
  {
    const scene::MeshPart& mesh = value.meshes[n];
    const scene::Placement place = scene::placementOf(value, mesh);
    const std::string refusal = place.missing.empty() ? facts.meshes[n].touchRefusal : "";
    std::string measure;
    if (const auto& measured = facts.meshes[n].measure)
      measure = measured->volume ? ", " + fixed(*measured->volume, 1) + " mm3"
                                 : ", open, " + std::to_string(measured->openEdges) + " edges";
    context.print("  mesh '" + mesh.name + "', " + std::to_string(mesh.triangles) + " triangles" +
                  measure + drilledText(mesh.name) + placeText(value, place) +
                  errorText(mesh.name) + (refusal.empty() ? "" : ", not touchable: " + refusal));
    for (const std::string& note : mesh.notes) // which alone say what its file did not
      context.print("    " + note);
  }
  context.print("  " + std::to_string(value.applied()) +
                (value.applied() == 1 ? " stroke done, " : " strokes done, ") +
                std::to_string(value.dissection.history().ahead()) + " to redo, " +
                fixed(value.removedVolume(), 1) + " mm3 removed");
}

// What became of each structure of the files.
void printStructures(const Context& context, const std::vector<presenters::StructureReport>& all,
                     nlohmann::json& info)
{
  using Status = presenters::StructureReport::Status;
  nlohmann::json list = nlohmann::json::array();
  for (const presenters::StructureReport& one : all)
  {
    nlohmann::json entry = {{"name", one.name},
                            {"status", presenters::nameOf(one.status)},
                            {"voxels", one.voxels},
                            {"volume_mm3", one.volume},
                            {"layer", one.layer}};
    if (one.fileVolume)
      entry["volume_file_mm3"] = *one.fileVolume;
    if (!one.why.empty())
      entry["why"] = one.why;
    list.push_back(std::move(entry));
    if (one.status == Status::Unread)
      context.warn("'" + one.name + "' was not read" + (one.why.empty() ? "" : ": " + one.why));
    // Thin structures lose or gain by voxels: said where it is more than a hundredth.
    constexpr double kNoted = 0.01;
    if (const auto error = one.volumeError(); error && std::abs(*error) > kNoted)
      context.print("  '" + one.name + "': " + fixed(*one.fileVolume, 1) + " mm3 in the file, " +
                    fixed(one.volume, 1) + " mm3 of voxels");
  }
  if (!all.empty())
    context.print("  " + presenters::summaryOf(all).text);
  info["structures"] = std::move(list);
}

/// How many parts a case had.
struct PartCounts
{
  PartCounts() = default;
  explicit PartCounts(const scene::Case& value)
    : mr(value.mr.size())
    , labels(value.labels.size())
    , meshes(value.meshes.size())
    , hasImage(true)
  {
    for (const scene::LabelPart& part : value.labels)
      labelNotes.push_back(part.notes.size());
  }

  std::size_t mr = 0, labels = 0, meshes = 0;
  std::vector<std::size_t> labelNotes; ///< of each of the label maps
  bool hasImage = false;
};

// What was accepted or assumed when the parts were read that came after `before`, and what that
// changed in those that were there.
void warnNotes(const Context& context, const scene::Case& value, const PartCounts& before = {})
{
  const auto from = [](const auto& parts, std::size_t first)
  { return parts.begin() + static_cast<std::ptrdiff_t>(std::min(first, parts.size())); };
  const auto remark = [&context](const auto& part)
  {
    for (const std::string& note : part.notes)
      context.warn(part.name + ": " + note);
  };
  for (const std::string& note : before.hasImage ? std::vector<std::string>() : value.ct.notes)
    context.warn((value.ct.modality == scene::Modality::Mr ? "MR" : value.ct.name) + ": " + note);
  std::for_each(from(value.mr, before.mr), value.mr.end(), remark);
  for (std::size_t n = 0; n < value.labels.size(); ++n)
  {
    const scene::LabelPart& part = value.labels[n];
    const std::size_t known = n < before.labels ? before.labelNotes[n] : 0;
    for (auto note = from(part.notes, known); note != part.notes.end(); ++note)
      context.warn(
          (part.structures.size() == 1 ? part.structures.front().name : std::string("labels")) +
          ": " + *note);
  }
  std::for_each(from(value.meshes, before.meshes), value.meshes.end(), remark);
}

// Structures and meshes that lie with the slices of the CT and were not given. `reports`: of the
// structures that were.
void warnOfParts(const Context& context, const presenters::CaseSources& sources,
                 const scene::Case& value, const std::vector<presenters::StructureReport>& reports)
{
  if (!std::filesystem::is_directory(sources.ct))
    return;
  std::vector<std::filesystem::path> given;
  std::error_code error;
  for (const auto* kind : {&sources.parts.labels, &sources.parts.meshes})
    for (const presenters::PartSource& source : *kind)
      given.push_back(std::filesystem::weakly_canonical(source.path, error));
  const auto scan = imaging::scanDicom(sources.ct, {}, library::scanCache().get());
  std::string text;
  for (const presenters::PartFiles& files : presenters::partFilesOf(sources.ct, scan, {}))
  {
    const auto isGiven = [&](const std::filesystem::path& path)
    {
      const auto canonical = std::filesystem::weakly_canonical(path, error);
      return std::any_of(given.begin(), given.end(),
                         [&](const auto& one)
                         { return one == canonical || one.parent_path() == canonical; });
    };
    // The same structures in another form, each a file of its name; also one that no voxel carries.
    const auto isOne = [&](const std::filesystem::path& path)
    {
      const std::string name = imaging::baseName(path);
      return scene::kindOfPart(value, name) ||
             std::any_of(reports.begin(), reports.end(),
                         [&name](const auto& report) { return report.name == name; });
    };
    const auto isTaken = [&](const std::filesystem::path& path)
    {
      using Folder = std::filesystem::directory_iterator;
      return std::filesystem::is_directory(path, error)
                 ? std::all_of(Folder(path, error), Folder(), isOne)
                 : isOne(path);
    };
    if (!std::any_of(files.paths.begin(), files.paths.end(), isGiven) &&
        !std::all_of(files.paths.begin(), files.paths.end(), isTaken))
      text += (text.empty() ? "" : "; ") +
              core::printable(files.paths.size() == 1 ? files.paths.front()
                                                      : files.paths.front().parent_path()) +
              " (" + files.text + ")";
  }
  if (!text.empty())
    context.warn("with the CT's slices lie structures that were not taken: " + text +
                 "; --labels and --mesh take them, 'petrous scan' says on which grid they are");
}

void addNew(CLI::App& app, Context& context)
{
  struct Options
  {
    std::string name, ct, series, volume, roi, modality, frame, axes, unit;
    PartOptions parts;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "new", "Build a case from a CT and what belongs to it",
      [options, &context]
      {
        presenters::CaseSources sources;
        sources.ct = options->ct;
        sources.series = options->series;
        if (!options->volume.empty())
          sources.series += "#" + options->volume;
        sources.repair = options->parts.repair;
        sources.undeclaredBits = undeclaredBitsOf(options->parts.bits);
        sources.modality = options->modality == "MR"   ? scene::Modality::Mr
                           : options->modality == "CT" ? scene::Modality::Ct
                                                       : scene::Modality::Unknown;
        if (!options->frame.empty())
          sources.assumeRas = options->frame == "ras";
        if (!options->axes.empty())
          sources.axes = parseAxes(options->axes, "--ct-axes");
        if (!options->unit.empty())
        {
          if (isDicomImage(options->ct))
            throw UsageError("--ct-unit goes with a CT file of voxels; DICOM states its lengths in "
                             "mm");
          sources.unit = millimetresOf(options->unit);
        }
        if (!options->roi.empty())
          sources.roi = parseBox(options->roi, "--roi");
        sources.parts = options->parts.sources();
        library::Library library = context.openLibrary();
        scene::checkCaseName(options->name);
        library::refuseTakenName(library.folder(), options->name); // before minutes of reading
        const core::Progress progress = context.progress();
        std::vector<presenters::StructureReport> structures;
        scene::Case value =
            presenters::buildCase(options->name, sources, progress.part(0.0, 0.8), &structures);
        library.save(value, progress.part(0.8, 1.0));
        warnNotes(context, value);
        warnOfParts(context, sources, value, structures);
        const CaseFacts facts = factsOf(value);
        printCase(context, value, facts);
        nlohmann::json info = infoJson(value, facts);
        printStructures(context, structures, info);
        context.printJson(info);
      });
  command->add_option("CASE", options->name, "Name of the new case")->required();
  command->add_option("--ct", options->ct, "DICOM folder, or NIfTI, NRRD or MetaImage file")
      ->type_name("PATH")
      ->required();
  command
      ->add_option("--modality", options->modality,
                   "What the primary image is, if the file does not say: CT (cone beam too) or MR")
      ->check(oneOf({"CT", "MR"}));
  command
      ->add_option("--ct-frame", options->frame,
                   "Axes of an image file that does not say which side is left: lps or ras")
      ->check(oneOf({"lps", "ras"}));
  command
      ->add_option("--ct-axes", options->axes,
                   "Corrects axes that the file states wrongly: where that points which it calls "
                   "left, posterior and superior, such as RPS for a mirrored one")
      ->type_name("XYZ");
  command
      ->add_option("--ct-unit", options->unit,
                   "Unit of length of a CT file of voxels, instead of what it states")
      ->check(oneOf({"mm", "cm", "m", "um", "nm", "inch"}));
  command->add_option("--series", options->series, "Which series of the folder")->type_name("UID");
  command
      ->add_option("--volume", options->volume,
                   "Which volume of a series or file with several, as 'petrous scan' names it")
      ->type_name("NAME");
  command->add_option("--roi", options->roi, "Part of the CT to load, patient LPS mm")
      ->type_name("x0,x1,y0,y1,z0,z1");
  options->parts.addTo(*command);
}

void addAdd(CLI::App& app, Context& context)
{
  struct Options
  {
    std::string name;
    PartOptions parts;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "add", "Add MR, structures or meshes to a case",
      [options, &context]
      {
        auto sources = options->parts.sources();
        if (!options->parts.bits.empty() && sources.mr.empty())
          throw UsageError("--bits goes with --mr");
        if (sources.mr.empty() && sources.labels.empty() && sources.meshes.empty())
          throw UsageError("add: nothing to add; give --mr, --labels or --mesh");
        library::Library library = context.openLibrary();
        sources.salted = library::frameSalter(library);
        scene::Case value = library.open(options->name);
        const PartCounts before(value);
        std::vector<presenters::StructureReport> structures;
        presenters::addParts(value, sources, context.progress(), &structures);
        library.save(value);
        warnNotes(context, value, before);
        const CaseFacts facts = factsOf(value);
        printCase(context, value, facts);
        nlohmann::json info = infoJson(value, facts);
        printStructures(context, structures, info);
        context.printJson(info);
      });
  command->add_option("CASE", options->name)->required();
  options->parts.addTo(*command);
}

// What of a case stays with it alone.
std::string leftText(const presenters::LeftBehind& left)
{
  std::string text;
  const auto add = [&text](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  const auto count = [&add](std::size_t number, const std::string& one)
  {
    if (number > 0)
      add(std::to_string(number) + " " + one + (number == 1 ? "" : "s"));
  };
  if (!left.mr.empty())
    add((left.mr.size() == 1 ? "MR " : "MRs ") + scene::listed(left.mr));
  if (!left.drawnOnMr.empty())
    add(scene::listed(left.drawnOnMr) + ", drawn on an MR");
  count(left.strokes, "stroke");
  count(left.measurements, "measurement");
  count(left.attachments, "attachment");
  count(left.savedViews, "saved view");
  return text;
}

void addCorrectAxes(CLI::App& app, Context& context)
{
  struct Options
  {
    std::string name, axes, as, part;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "correct-axes",
      "Correct the axes that a file states wrongly: make a case of another one's CT, or correct a "
      "part of a case",
      [options, &context]
      {
        const core::AxesCorrection axes = parseAxes(options->axes, "--axes");
        if (axes.isIdentity())
          throw UsageError("--axes: LPS leaves the axes as they are");
        if (options->as.empty() == options->part.empty())
          throw UsageError("give --as for the CT, or --part");
        library::Library library = context.openLibrary();
        if (!options->part.empty())
        {
          scene::Case value = library.open(options->name);
          const presenters::AxesPart part =
              presenters::axesPart(value, partNamed(value, options->part));
          const presenters::AxesFollowers followers = presenters::axesFollowers(value, part);
          presenters::correctPart(value, part, axes);
          library.save(value);
          if (!followers.parts.empty())
            context.warn("goes along: " + scene::listed(followers.parts));
          if (!followers.unregistered.empty())
            context.warn("is to be registered again: " + scene::listed(followers.unregistered));
          const CaseFacts facts = factsOf(value);
          printCase(context, value, facts);
          context.printJson(infoJson(value, facts));
          return;
        }
        scene::checkCaseName(options->as);
        library::refuseTakenName(library.folder(), options->as);
        const scene::Case from = library.open(options->name);
        scene::Case value = presenters::correctedCase(from, axes, options->as, context.progress());
        library.save(value);
        if (const std::string left = leftText(presenters::leftBehind(from)); !left.empty())
          context.warn("stays with case '" + from.name + "' alone: " + left);
        if (from.description.side != scene::Side::Unknown)
          context.warn("which ear it is was not taken over; 'petrous describe --side' says it");
        const CaseFacts facts = factsOf(value);
        printCase(context, value, facts);
        context.printJson(infoJson(value, facts));
      });
  command->add_option("CASE", options->name)->required();
  command
      ->add_option("--axes", options->axes,
                   "Where that really points which is now left, posterior and superior, such as "
                   "RPS for a mirrored one")
      ->type_name("XYZ")
      ->required();
  command->add_option("--as", options->as, "Name of the new case, of the CT")->type_name("NAME");
  command
      ->add_option(
          "--part", options->part,
          "An MR, with what was drawn on it, a structure, with those of its file, or a mesh "
          "of the case itself")
      ->type_name("NAME");
}

void addRemove(CLI::App& app, Context& context)
{
  struct Options
  {
    std::string name, part;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      context.addCommand(app, "remove", "Take an MR, a structure or a mesh out of a case",
                         [options, &context]
                         {
                           library::Library library = context.openLibrary();
                           scene::Case value = library.open(options->name);
                           scene::removePart(value, partNamed(value, options->part));
                           library.save(value);
                           const CaseFacts facts = factsOf(value);
                           printCase(context, value, facts);
                           context.printJson(infoJson(value, facts));
                         });
  command->add_option("CASE", options->name)->required();
  command->add_option("--part", options->part, "Its name")->type_name("NAME")->required();
}

void addInfo(CLI::App& app, Context& context)
{
  auto name = std::make_shared<std::string>();
  auto exposed = std::make_shared<bool>(false);
  CLI::App* command = context.addCommand(
      app, "info", "What a case holds",
      [name, exposed, &context]
      {
        const library::Library library = context.openLibrary();
        scene::Case value = library.open(*name);
        nlohmann::json areas = nlohmann::json::array();
        const CaseFacts facts = factsOf(value);
        printCase(context, value, facts);
        const std::vector<std::string> lost = library.lost(value);
        for (const std::string& words : lost)
          context.print("  " + words);
        if (*exposed)
        {
          library.loadDissection(value);
          for (const auto& surface : scene::exposedSurfaces(value, context.progress()))
          {
            context.print("  of '" + surface.name + "' laid open: " + fixed(surface.area, 1) +
                          " mm2");
            areas.push_back({{"label", surface.name}, {"area_mm2", surface.area}});
          }
        }
        nlohmann::json info = infoJson(value, facts);
        if (*exposed)
          info["dissection"]["exposed"] = std::move(areas);
        if (!lost.empty())
          info["lost"] = lost;
        context.printJson(info);
      });
  command->add_option("CASE", *name)->required();
  command->add_flag("--exposed", *exposed,
                    "Also how much of each structure's surface was laid open (takes a moment)");
}

} // namespace

void addCaseCommands(CLI::App& app, Context& context)
{
  addNew(app, context);
  addAdd(app, context);
  addCorrectAxes(app, context);
  addRemove(app, context);
  addInfo(app, context);
}

} // namespace petrous::cli
