#include "PeerRegistration.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

#include "ChildProcess.h"
#include "petrous/Core/Error.h"
#include "petrous/Core/NumberText.h"

namespace petrous::registration
{

namespace
{

namespace fs = std::filesystem;

constexpr const char* kParameters = R"(
(FixedInternalImagePixelType "float")
(MovingInternalImagePixelType "float")
(FixedImageDimension 3)
(MovingImageDimension 3)
(UseDirectionCosines "true")
(Registration "MultiResolutionRegistration")
(Interpolator "LinearInterpolator")
(ResampleInterpolator "FinalBSplineInterpolator")
(Resampler "DefaultResampler")
(FixedImagePyramid "FixedSmoothingImagePyramid")
(MovingImagePyramid "MovingSmoothingImagePyramid")
(Optimizer "AdaptiveStochasticGradientDescent")
(Transform "EulerTransform")
(Metric "AdvancedMattesMutualInformation")
(AutomaticScalesEstimation "true")
(AutomaticTransformInitialization "false")
(HowToCombineTransforms "Compose")
(ErodeMask "false")
(NumberOfSpatialSamples 4096)
(NewSamplesEveryIteration "true")
(ImageSampler "RandomCoordinate")
(CheckNumberOfSamples "true")
(RequiredRatioOfValidSamples 0.05)
(MaximumNumberOfSamplingAttempts 8)
(BSplineInterpolationOrder 1)
(FinalBSplineInterpolationOrder 1)
(DefaultPixelValue 0)
(WriteResultImage "false")
(RandomSeed 121212)
)";

template <class T>
constexpr const char* kElement = nullptr;
template <>
constexpr const char* kElement<std::int16_t> = "MET_SHORT";
template <>
constexpr const char* kElement<std::uint16_t> = "MET_USHORT";
template <>
constexpr const char* kElement<float> = "MET_FLOAT";

void must(bool done, const fs::path& path)
{
  if (!done)
    throw core::Error(core::Fault::Internal, path.string() + ": cannot be written");
}

} // namespace

void writeMetaImage(const fs::path& path, const volume::IntensityVolume& image)
{
  const core::GridGeometry& grid = image.geometry();
  fs::path raw = path;
  raw.replace_extension(".raw");
  image.visit(
      [&](const auto& voxels)
      {
        using Value = typename std::decay_t<decltype(voxels)>::Value;
        std::ofstream header(path);
        header.imbue(std::locale::classic());
        header.precision(12);
        header << "ObjectType = Image\nNDims = 3\nBinaryData = True\n"
               << "BinaryDataByteOrderMSB = False\nTransformMatrix =";
        for (Eigen::Index axis = 0; axis < 3; ++axis)
          header << ' ' << grid.direction().col(axis).transpose();
        header << "\nOffset = " << grid.origin().transpose()
               << "\nElementSpacing = " << grid.spacing().transpose()
               << "\nDimSize = " << grid.dims()[0] << ' ' << grid.dims()[1] << ' ' << grid.dims()[2]
               << "\nElementType = " << kElement<Value> << "\nElementDataFile = "
               << raw.filename().string() << '\n';
        must(static_cast<bool>(header.flush()), path);
        std::ofstream data(raw, std::ios::binary);
        data.write(reinterpret_cast<const char*>(voxels.data()),
                   static_cast<std::streamsize>(voxels.bytes()));
        must(static_cast<bool>(data.flush()), raw);
      });
}

namespace
{

// Values of "(Name v v ...)"; empty if absent.
std::vector<std::string> entry(const std::string& text, const std::string& name)
{
  const auto begin = text.find("(" + name + " ");
  if (begin == std::string::npos)
    return {};
  std::istringstream words(
      text.substr(begin + name.size() + 2, text.find(')', begin) - begin - name.size() - 2));
  return {std::istream_iterator<std::string>(words), {}};
}

} // namespace

std::optional<std::string> elastixVersion()
{
  FILE* pipe = ::popen("elastix --version 2>/dev/null", "r");
  if (!pipe)
    return std::nullopt;
  std::array<char, 128> line{};
  const bool any = std::fgets(line.data(), line.size(), pipe) != nullptr;
  if (::pclose(pipe) != 0 || !any)
    return std::nullopt;
  std::istringstream words(line.data());
  std::string word, last;
  while (words >> word)
    last = word;
  return "elastix " + last;
}

core::RigidTransform elastixTransform(const std::string& parameters)
{
  const auto p = entry(parameters, "TransformParameters");
  const auto c = entry(parameters, "CenterOfRotationPoint");
  const auto zyx = entry(parameters, "ComputeZYX");
  const auto kind = entry(parameters, "Transform");
  if (p.size() != 6 || c.size() != 3 || kind.size() != 1 || kind[0] != "\"EulerTransform\"" ||
      (!zyx.empty() && zyx[0] != "\"false\""))
    throw core::Error(core::Fault::BadInput, "elastix: its result is no Euler transform of z x y");
  const auto number = [](const std::string& word)
  {
    const auto value = core::parseDouble(word);
    if (!value)
      throw core::Error(core::Fault::BadInput,
                        "elastix: '" + word + "' in its result is not a number");
    return *value;
  };
  std::array<double, 6> v{};
  for (std::size_t i = 0; i < 6; ++i)
    v[i] = number(p[i]);
  const Vector3d center(number(c[0]), number(c[1]), number(c[2]));
  const Eigen::Quaterniond turn = Eigen::AngleAxisd(v[2], Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(v[0], Vector3d::UnitX()) *
                                  Eigen::AngleAxisd(v[1], Vector3d::UnitY());
  return {turn, center + Vector3d(v[3], v[4], v[5]) - turn * center};
}

std::string ElastixSchedule::name() const
{
  return std::to_string(resolutions) + " x " + std::to_string(iterations) + ", " +
         std::to_string(bins) + " bins";
}

const std::vector<ElastixSchedule>& elastixSchedules()
{
  static const std::vector<ElastixSchedule> all{{3, 50, 32},  {3, 100, 32}, {3, 100, 64},
                                                {3, 250, 64}, {4, 500, 32}, {4, 500, 64},
                                                {4, 2000, 64}};
  return all;
}

std::optional<PeerFit> runElastix(const RegistrationPair& pair, const fs::path& work, int threads,
                                  const ElastixSchedule& schedule)
{
  const fs::path out = work / "elastix";
  fs::create_directories(out);
  writeMetaImage(work / "fixed.mhd", *pair.ct);
  writeMetaImage(work / "moving.mhd", *pair.mr);
  std::ofstream file(work / "rigid.txt");
  file << kParameters << "(NumberOfResolutions " << schedule.resolutions
       << ")\n(MaximumNumberOfIterations " << schedule.iterations << ")\n(NumberOfHistogramBins "
       << schedule.bins << ")\n";
  must(static_cast<bool>(file.flush()), work / "rigid.txt");
  file.close();
  const fs::path result = out / "TransformParameters.0.txt";
  std::error_code ignored;
  fs::remove(result, ignored);
  const ProcessTimes times = runProcess(
      {"elastix", "-f", (work / "fixed.mhd").string(), "-m", (work / "moving.mhd").string(), "-p",
       (work / "rigid.txt").string(), "-out", out.string(), "-threads", std::to_string(threads)});
  std::ifstream written(result);
  if (times.status != 0 || !written)
    return std::nullopt;
  return PeerFit{elastixTransform({std::istreambuf_iterator<char>(written), {}}), times.seconds,
                 times.processorSeconds};
}

} // namespace petrous::registration
