#include "RenderOptions.h"

#include <cmath>
#include <tuple>

#include "CaseWarnings.h"
#include "Numbers.h"
#include "petrous/Presenters/SceneAssembly.h"

namespace petrous::cli
{

namespace
{

rendering::ClippingPlane parsePlane(const std::string& text)
{
  const auto n = parseNumbers(text, 6, "--clip x,y,z,nx,ny,nz");
  const Eigen::Vector3d normal(n[3], n[4], n[5]);
  const double length = normal.stableNorm();
  if (!(length > 1e-12) || !std::isfinite(length))
    throw UsageError("--clip x,y,z,nx,ny,nz: the normal must not be zero; it points to what stays");
  return {{n[0], n[1], n[2]}, normal / length};
}

std::optional<core::IndexBox> parseCrop(const RenderOptions& options,
                                        const core::GridGeometry& grid)
{
  core::IndexBox box;
  if (!options.crop.empty())
  {
    const char* name = "--crop i0,i1,j0,j1,k0,k1";
    const auto n = parseNumbers(options.crop, 6, name);
    for (std::size_t a = 0; a < 3; ++a)
    {
      box.lower[a] = toInt(n[2 * a], name);
      box.upper[a] = toInt(n[2 * a + 1], name);
      if (box.lower[a] < box.upper[a])
        ++box.upper[a];
      else
        throw UsageError(std::string(name) + ": first and last voxel; each first number must be "
                                             "the smaller one");
    }
  }
  else if (!options.roi.empty())
  {
    const core::PatientBox roi = parseBox(options.roi, "--roi");
    box = grid.boxCovering(roi.min(), roi.max());
  }
  else
    return std::nullopt;
  const core::IndexBox inside = box.intersected(grid.fullBox());
  if (inside.empty())
    throw UsageError(std::string(options.crop.empty() ? "--roi" : "--crop") +
                     ": nothing of the CT lies in it");
  return inside;
}

} // namespace

Shot parseShot(const RenderOptions& options)
{
  Shot shot;
  std::tie(shot.width, shot.height) = parseSize(options.size);
  shot.stereo = *rendering::parseStereoMode(options.stereo);
  if (shot.stereo == rendering::StereoMode::None && (options.eyeSeparation || options.convergence))
    throw UsageError("--eye-separation and --convergence need --stereo");
  if (shot.stereo == rendering::StereoMode::SideBySide && shot.width % 2 != 0)
    throw UsageError("--size: side by side needs an even width, not " + std::to_string(shot.width));
  if (options.clip.size() > 6)
    throw UsageError("--clip: at most 6 planes, not " + std::to_string(options.clip.size()));
  if (!options.crop.empty() && !options.roi.empty())
    throw UsageError("render: give --crop or --roi, not both");
  return shot;
}

rendering::SceneContents renderContents(const RenderOptions& options, const scene::Case& value)
{
  presenters::SceneAssembly assembly;
  assembly.showThickness(options.thickness);
  rendering::SceneContents contents = assembly.contents(value);
  contents.light.falloff = options.falloff;
  contents.light.wetness = options.wetness;
  for (const std::string& plane : options.clip)
    contents.clipping.push_back(parsePlane(plane));
  contents.crop = parseCrop(options, value.ct.geometry);
  return contents;
}

void addRenderOptions(CLI::App& command, RenderOptions& options)
{
  command.add_option("CASE", options.caseName)->required();
  command.add_option("--out", options.out, "Picture to write")
      ->type_name("F.png")
      ->check(endsIn(".png"))
      ->required();
  command.add_option("--size", options.size, "Pixels (800x600)")->type_name("WxH");
  command
      .add_option("--view", options.view,
                  "lateral, left, right, superior, inferior, anterior or posterior")
      ->check(oneOf({"lateral", "left", "right", "superior", "inferior", "anterior", "posterior"}));
  command.add_option("--camera", options.camera, "Camera in patient LPS mm")->type_name("F.json");
  command
      .add_option("--stereo", options.stereo, "none, side-by-side, interleaved or anaglyph (none)")
      ->check(oneOf({"none", "side-by-side", "interleaved", "anaglyph"}));
  command
      .add_option("--eye-separation", options.eyeSeparation,
                  "Between the eyes (5.5 degrees where they converge)")
      ->type_name("MM")
      ->check(within({0.0, rendering::StereoRig::kLargestSeparation, "mm"}));
  command
      .add_option("--convergence", options.convergence,
                  "From the camera to where the eyes converge (the focal point)")
      ->type_name("MM")
      ->check(within({rendering::StereoRig::kNearestConvergence,
                      rendering::StereoRig::kFarthestConvergence, "mm"}));
  command
      .add_option("--light-falloff", options.falloff,
                  "Distance at which the lamp's light is halved; 0: the same everywhere (0)")
      ->type_name("MM")
      ->check(within({0.0, 10000.0, "mm"}));
  command.add_option("--wetness", options.wetness, "Gloss of a wet surface (0)")
      ->check(within({0.0, 1.0}));
  command
      .add_option("--thickness", options.thickness,
                  "Colour bone by its thickness over a structure, 0 to 5 mm")
      ->type_name("STRUCTURE");
  command
      .add_option("--clip", options.clip,
                  "Plane through a point, patient LPS mm; the normal points to what stays (up to "
                  "6 times)")
      ->allow_extra_args(false)
      ->type_name("x,y,z,nx,ny,nz");
  command.add_option("--crop", options.crop, "First and last voxel of the CT that are drawn")
      ->type_name("i0,i1,j0,j1,k0,k1");
  command.add_option("--roi", options.roi, "Part of the CT that is drawn, patient LPS mm")
      ->type_name("x0,x1,y0,y1,z0,z1");
  command
      .add_option("--engine", options.engine,
                  "gpu, or reference: double precision on the CPU, slow (gpu)")
      ->check(oneOf({"gpu", "reference"}));
  command.add_option("--depth", options.depth, "Also write the distance to the first surface, mm")
      ->type_name("F.npy")
      ->check(endsIn(".npy"));
  addWithoutDamaged(command, options.withoutDamaged);
}

} // namespace petrous::cli
