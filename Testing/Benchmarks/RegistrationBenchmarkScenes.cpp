#include "RegistrationBenchmarkScenes.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <optional>

#include <nlohmann/json.hpp>

#include "BenchmarkPatients.h"
#include "ChildProcess.h"
#include "Context.h"
#include "Numbers.h"
#include "PhantomPairs.h"
#include "Program.h"
#include "RireFolder.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Imaging/DicomReader.h"
#include "petrous/Imaging/ImageFile.h"
#include "petrous/Volume/TissueExtent.h"

namespace petrous::cli
{

namespace
{

namespace fs = std::filesystem;
using registration::BenchmarkInput;
using registration::MrContrast;
using registration::RegistrationPair;
using registration::SimulationBody;
using registration::Vector3d;

// Position of the inner ears relative to the centre of a head's bone, and width and depth of a head
// including skin around that, mm.
const Vector3d kEar(33.0, 0.0, -29.0);
const Eigen::Vector2d kHead(190.0, 250.0);

// The largest CT below the folder, cropped to the head.
std::optional<SimulationBody> realBody(const fs::path& data, bool quick,
                                       const core::Progress& progress)
{
  const auto whole = realCt(data, progress.part(0.0, 0.6));
  if (!whole)
    return std::nullopt;
  const auto extent = volume::tissueExtent(*whole, kBenchmarkIso);
  const auto bounds = whole->geometry().patientBounds();
  Vector3d box = bounds.sizes();
  box.head<2>() = box.head<2>().cwiseMin(kHead);
  SimulationBody body;
  body.name = "real head";
  body.ct = registration::croppedTo(*whole, extent.center, box);
  body.ears = {extent.center + kEar.cwiseProduct(Vector3d(-1.0, 1.0, 1.0)), extent.center + kEar};
  const auto add = [&body](const char* name, MrContrast contrast)
  {
    body.contrasts.push_back({name, std::make_shared<const volume::Volume<float>>(
                                        registration::mrContrastOf(*body.ct, contrast, 1))});
  };
  progress.report(0.7, "what an MR would show");
  add("T1", MrContrast::T1);
  if (!quick)
  {
    add("T2", MrContrast::T2);
    add("DWI", MrContrast::Diffusion);
  }
  return body;
}

RegistrationPair pairOf(const fs::path& folder, const core::Progress& progress)
{
  RegistrationPair pair;
  pair.name = folder.filename().string();
  pair.ct = imaging::readImageFile(folder / "fixed.nii.gz", std::nullopt, progress).volume;
  pair.mr = imaging::readImageFile(folder / "moving.nii.gz", std::nullopt, progress).volume;
  const fs::path path = folder / "truth.json";
  try
  {
    const auto json = nlohmann::json::parse(core::readFile(path));
    Eigen::Matrix4d matrix;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column)
        matrix(row, column) = json.at("T").at(row).at(column).get<double>();
    const core::RigidTransform truth(
        Eigen::Quaterniond(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())),
        matrix.topRightCorner<3, 1>());
    pair.truth = [truth](const Vector3d& p) { return truth * p; };
    for (const auto& target : json.at("targets"))
      pair.targets.emplace_back(target.at(0).get<double>(), target.at(1).get<double>(),
                                target.at(2).get<double>());
    pair.exact = json.value("note", std::string()).find("exact") != std::string::npos;
  }
  catch (const nlohmann::json::exception&)
  {
    throw core::Error(core::Fault::BadInput,
                      path.string() + ": must hold \"T\", a 4x4, and \"targets\"");
  }
  if (pair.targets.empty())
    throw core::Error(core::Fault::BadInput, path.string() + ": names no target");
  return pair;
}

std::vector<RegistrationPair> filePairs(const fs::path& folder, const core::Progress& progress)
{
  std::vector<fs::path> folders;
  if (!folder.empty() && fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder))
      if (fs::exists(entry.path() / "truth.json"))
        folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  std::vector<RegistrationPair> pairs;
  for (const fs::path& path : folders)
    pairs.push_back(pairOf(path, progress));
  return pairs;
}

// A 4D NIfTI, as from a diffusion series, with all values zero.
fs::path writeFourDimensions(const fs::path& work, int volumes)
{
  std::array<char, 352> header{};
  const auto put = [&header](std::size_t at, auto value)
  { std::memcpy(header.data() + at, &value, sizeof value); };
  put(0, std::int32_t{348});
  const std::int16_t dim[8] = {4, 16, 16, 16, static_cast<std::int16_t>(volumes), 1, 1, 1};
  std::memcpy(header.data() + 40, dim, sizeof dim);
  put(70, std::int16_t{4}); // int16
  put(72, std::int16_t{16});
  for (std::size_t n = 0; n < 5; ++n)
    put(76 + 4 * n, 1.0F);   // pixdim
  put(108, 352.0F);          // vox_offset
  put(112, 1.0F);            // scl_slope
  header[123] = 2;           // mm
  put(254, std::int16_t{1}); // sform
  for (std::size_t row = 0; row < 3; ++row)
    put(280 + 16 * row + 4 * row, 1.0F);
  std::memcpy(header.data() + 344, "n+1", 4);
  const fs::path path = work / ("series-of-" + std::to_string(volumes) + ".nii");
  std::ofstream file(path, std::ios::binary);
  file.write(header.data(), header.size());
  const std::string zeros(static_cast<std::size_t>(2 * 16 * 16 * 16 * volumes), '\0');
  file << zeros;
  return path;
}

std::vector<registration::StressTrial> fourDimensions(const fs::path& work,
                                                      const SimulationBody& body)
{
  std::vector<registration::StressTrial> trials;
  for (const int volumes : {2, 5, 30})
    trials.push_back(
        {"MR of four dimensions", std::to_string(volumes) + " volumes in one file",
         [path = writeFourDimensions(work, volumes), ct = body.ct, ear = body.ears.front()]
         {
           RegistrationPair pair;
           pair.ct = ct;
           pair.mr = imaging::readImageFile(path).volume;
           pair.targets = {ear};
           return pair;
         },
         false});
  return trials;
}

// Pairs for judging settings, none of which is used for comparison with other programs.
std::vector<RegistrationPair> tuningPairs(const std::vector<SimulationBody>& bodies, bool quick,
                                          const core::Progress& progress)
{
  std::vector<RegistrationPair> pairs;
  for (std::uint64_t seed = 101; seed <= (quick ? 101U : 103U); ++seed)
    pairs.push_back(phantomPair(seed, quick, progress));
  for (const SimulationBody& body : bodies)
    for (std::uint64_t n = 0; n < 3 && body.contrasts.size() > 2; ++n) // the real head
    {
      auto recipe = registration::usualRecipe(body, n, 200 + n);
      recipe.contrast = 1 + n % 2; // T2 and diffusion: ct_mr_sim already has a T1
      pairs.push_back(registration::simulatePair(body, n, recipe));
    }
  return pairs;
}

// Runs `petrous register` on a case of the pair, created by another process from the files that
// elastix reads.
std::optional<registration::PeerFit> registerInProcess(const RegistrationPair& pair,
                                                       const fs::path& work)
{
  const std::string self = programBeside("petrous", "../../Application/Cli").string();
  const fs::path library = work / "library";
  fs::remove_all(library);
  registration::writeMetaImage(work / "fixed.mhd", *pair.ct);
  registration::writeMetaImage(work / "moving.mhd", *pair.mr);
  const std::vector<std::string> common{"--library", library.string(), "--quiet"};
  const auto run = [&common](std::vector<std::string> words, const fs::path& output)
  {
    words.insert(words.end(), common.begin(), common.end());
    return registration::runProcess(words, output);
  };
  if (run({self, "new", "pair", "--ct", (work / "fixed.mhd").string(), "--mr",
           "MR=" + (work / "moving.mhd").string()},
          {})
          .status != 0)
    return std::nullopt;
  const Vector3d& at = pair.targets.front();
  const fs::path answer = work / "answer.json";
  const auto times = run({self, "register", "pair", "--mr", "MR", "--json", "--at",
                          fixed(at[0], 3) + "," + fixed(at[1], 3) + "," + fixed(at[2], 3)},
                         answer);
  if (times.status != 0)
    return std::nullopt;
  std::ifstream file(answer);
  const auto numbers = nlohmann::json::parse(file).at("transform").get<std::vector<double>>();
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(numbers.data());
  return registration::PeerFit{{Eigen::Quaterniond(Eigen::Matrix3d(matrix.topLeftCorner<3, 3>())),
                                Vector3d(matrix.topRightCorner<3, 1>())},
                               times.seconds,
                               times.processorSeconds};
}

} // namespace

BenchmarkInput registrationScenes(const RegistrationScenes& scenes,
                                  std::map<std::string, std::string>& notes,
                                  const core::Progress& progress)
{
  BenchmarkInput input;
  input.quick = scenes.quick;
  input.work = scenes.work;
  input.parts = scenes.parts;
  input.process = [work = scenes.work](const RegistrationPair& pair)
  { return registerInProcess(pair, work); };
  if (!scenes.rire.empty())
  {
    input.rire = registration::rirePairs(scenes.rire);
    return input;
  }
  input.bodies.push_back(phantomBody(scenes.quick, progress.part(0.0, 0.4)));
  if (auto real = scenes.quick ? std::nullopt
                               : realBody(scenes.data, scenes.quick, progress.part(0.4, 0.7)))
    input.bodies.push_back(std::move(*real));
  else
    notes["real CT"] =
        scenes.quick ? "left out by --quick" : "none: --data names no folder with one";
  input.tuning = tuningPairs(input.bodies, scenes.quick, progress.part(0.7, 0.8));
  input.fileTrials = fourDimensions(scenes.work, input.bodies.front());
  for (int seed = 1; seed <= (scenes.quick ? 1 : 5); ++seed)
    input.pairs.push_back(phantomPair(static_cast<std::uint64_t>(seed), scenes.quick, progress));
  if (!scenes.quick)
  {
    auto files = filePairs(scenes.pairs, progress.part(0.8, 1.0));
    if (files.empty())
      notes["pairs of files"] =
          "none: --pairs names no folder of NAME/{fixed,moving}.nii.gz with NAME/truth.json";
    for (RegistrationPair& pair : files)
    {
      // Averages of many subjects: certainly none of our bodies.
      if (pair.name.find("template") != std::string::npos)
        input.others.push_back(pair);
      input.pairs.push_back(std::move(pair));
    }
  }
  return input;
}

} // namespace petrous::cli
