#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "CaseJson.h"
#include "CaseWarnings.h"
#include "Commands.h"
#include "Numbers.h"
#include "petrous/Imaging/FileFormats.h"
#include "petrous/Imaging/LabelFile.h"
#include "petrous/Imaging/MeshFile.h"
#include "petrous/Imaging/VolumeFile.h"
#include "petrous/Rendering/SurfaceExtraction.h"
#include "petrous/Scene/CaseField.h"
#include "petrous/Scene/Placement.h"

namespace petrous::cli
{

namespace
{

constexpr double kAirHu = -1000.0;

struct Options
{
  std::string caseName, what, out, part;
  bool withoutDamaged = false;
};

template <class T>
T rounded(double value)
{
  if constexpr (std::is_integral_v<T>)
    return static_cast<T>(std::lround(std::clamp(value, double{std::numeric_limits<T>::min()},
                                                 double{std::numeric_limits<T>::max()})));
  else
    return static_cast<T>(value);
}

// The CT after removal: untouched voxels keep their value, removed ones are air, and in between the
// value is capped so that the surface at `iso` is the cut surface of f.
template <class T>
volume::Volume<T> dissected(const volume::Volume<T>& ct, const volume::CutMask& mask, double iso)
{
  volume::Volume<T> result(ct.geometry());
  const core::Index3 n = ct.geometry().dims();
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i)
      {
        const std::uint16_t left = mask.at(i, j, k);
        T value = ct.at(i, j, k);
        if (left != volume::CutMask::kUntouched)
        {
          const double share = static_cast<double>(left) / volume::CutMask::kUntouched;
          const double cap = iso + (share - 0.5) * 2.0 * (iso - kAirHu);
          if (cap < static_cast<double>(value))
            value = rounded<T>(cap);
        }
        result.at(i, j, k) = value;
      }
  return result;
}

const scene::ImagePart& chooseMr(const scene::Case& value, const std::string& name)
{
  if (value.mr.empty())
    throw core::InvalidParameter("case '" + value.name + "' has no MR");
  if (name.empty() && value.mr.size() == 1)
    return value.mr.front();
  std::string there;
  for (const auto& mr : value.mr)
  {
    if (mr.name == name)
      return mr;
    there += (there.empty() ? "" : ", ") + mr.name;
  }
  throw UsageError("export mr: give --part NAME; there are: " + there);
}

// All structures of label maps that share a grid, merged into one map and numbered in order; where
// two overlap the earlier one is kept.
volume::LabelMap mergedLabels(const Context& context, const scene::Case& value,
                              const std::string& only, const presenters::LeftOut& leftOut)
{
  const auto isLeftOut = [&](const scene::LabelPart& labels)
  {
    return std::any_of(leftOut.labels.begin(), leftOut.labels.end(),
                       [&](const auto& part) { return &value.labels[part.index] == &labels; });
  };
  std::shared_ptr<volume::Volume<std::uint16_t>> voxels;
  std::vector<volume::Segment> segments;
  for (const auto& part : value.labels)
    for (const auto& structure : part.structures)
    {
      if (!only.empty() && structure.name != only)
        continue;
      if (isLeftOut(part))
      {
        if (!only.empty())
          throw core::InvalidParameter("export labels: '" + only +
                                       "' is missing or damaged, and nothing else is asked for");
        continue;
      }
      const auto placed = scene::labelsOnCt(value, part);
      if (!placed)
        context.warn("'" + structure.name + "' is written where its MR has it, not on the CT: " +
                     scene::missingPlace(value, structure.name));
      const auto& source = *(placed ? placed : part.labels.get())->voxels;
      if (!voxels)
        voxels =
            std::make_shared<volume::Volume<std::uint16_t>>(source.geometry(), std::uint16_t{0});
      if (!core::sameGrid(voxels->geometry(), source.geometry()))
        throw UsageError("export labels: '" + structure.name +
                         "' lies on another grid; export it alone with --part");
      const auto index = static_cast<std::uint16_t>(segments.size() + 1);
      std::transform(voxels->data(), voxels->data() + voxels->size(), source.data(), voxels->data(),
                     [&structure, index](std::uint16_t present, std::uint16_t own)
                     { return present == 0 && own == structure.index ? index : present; });
      volume::Segment segment;
      segment.name = structure.name;
      segment.index = index;
      segment.color = structure.look.color;
      segments.push_back(std::move(segment));
    }
  if (!voxels)
    throw core::InvalidParameter("case '" + value.name + "' has no " +
                                 (only.empty() ? "structures" : "structure '" + only + "'"));
  return volume::makeLabelMap(std::move(voxels), std::move(segments));
}

imaging::FileContent contentOf(const std::string& what)
{
  if (what == "labels")
    return imaging::kLabels;
  if (what == "surface")
    return imaging::kMesh;
  if (what != "ct" && what != "mr" && what != "mask" && what != "dissected")
    throw UsageError("--what: ct, mr, labels, mask, dissected or surface, not '" + what + "'");
  return imaging::kImage;
}

void exportCase(const Context& context, const Options& options)
{
  imaging::writingFormat(options.out, contentOf(options.what)); // before anything is computed
  context.refuseOverwriting({options.out});
  const library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  const core::Progress progress = context.progress();
  // Voxels mapped for the file must be what was stored.
  const auto checked = [&](const scene::ImagePart& image)
  {
    auto volume = image.volume.get();
    library.checkVoxels(value, progress);
    return volume;
  };
  const auto mask = [&]() -> const volume::CutMask&
  {
    library.loadDissection(value);
    return value.dissection.mask();
  };
  presenters::LeftOut leftOut;
  // Labels that are written are read, and thus checked; the surface is that of all structures.
  if (options.what == "surface" || (options.what == "labels" && options.withoutDamaged))
    leftOut = leaveOutDamaged(context, library, value, options.withoutDamaged);
  if (options.what == "ct")
    imaging::writeVolume(options.out, *checked(value.ct), progress);
  else if (options.what == "mr")
    imaging::writeVolume(options.out, *checked(chooseMr(value, options.part)), progress);
  else if (options.what == "labels")
    imaging::writeLabelFile(options.out, mergedLabels(context, value, options.part, leftOut));
  else if (options.what == "mask")
    imaging::writeVolume(options.out, mask().dense(), progress);
  else if (options.what == "dissected")
    checked(value.ct)->visit(
        [&](const auto& ct)
        { imaging::writeVolume(options.out, dissected(ct, mask(), value.iso), progress); });
  else // surface
  {
    mask();
    checked(value.ct);
    const volume::TissueField field = scene::tissueField(value);
    imaging::writeMesh(options.out,
                       rendering::extractSurface(field, field.geometry().fullBox(), progress));
  }
  context.print(options.out + ": " + options.what + " of '" + value.name + "'");
  context.printJson({{"case", value.name},
                     {"what", options.what},
                     {"out", options.out},
                     {"left_out", leftOutJson(value, leftOut)}});
}

} // namespace

void addExportCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(app, "export", "Voxels or a surface for other programs",
                                         [options, &context] { exportCase(context, *options); });
  command->add_option("CASE", options->caseName)->required();
  command->add_option("--what", options->what, "ct, mr, labels, mask, dissected or surface")
      ->check(oneOf({"ct", "mr", "labels", "mask", "dissected", "surface"}))
      ->required();
  command
      ->add_option("--out", options->out,
                   "Voxels: " + imaging::orText(imaging::writtenEndings(imaging::kImage)) +
                       "; labels: " + imaging::orText(imaging::writtenEndings(imaging::kLabels)) +
                       "; surface: " + imaging::orText(imaging::writtenEndings(imaging::kMesh)) +
                       "; mm LPS")
      ->type_name("F")
      ->required();
  command->add_option("--part", options->part, "One MR or structure of several")->type_name("NAME");
  addWithoutDamaged(*command, options->withoutDamaged);
}

} // namespace petrous::cli
