#include <limits>

#include "Commands.h"
#include "Numbers.h"
#include "petrous/Phantom/SamplePatient.h"

namespace petrous::cli
{

void addSampleCommand(CLI::App& app, Context& context)
{
  struct Options
  {
    std::string out;
    std::optional<double> spacing;
    std::string dims;
    double noise = phantom::SampleOptions{}.noise;
    double tilt = 0.0;
    std::uint64_t seed = 1;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = context.addCommand(
      app, "sample", "Write the built-in phantom patient",
      [options, &context]
      {
        phantom::SampleOptions sample;
        sample.spacing = options->spacing;
        if (!options->dims.empty())
        {
          const auto n = parseNumbers(options->dims, 3, "--dims I,J,K");
          for (const double count : n)
            if (!phantom::SampleOptions::kDims.contains(count))
              throw UsageError("--dims I,J,K: each " +
                               phantom::SampleOptions::kDims.refusal(count));
          sample.dims =
              core::Index3{toInt(n[0], "--dims"), toInt(n[1], "--dims"), toInt(n[2], "--dims")};
        }
        sample.noise = options->noise;
        sample.tilt = options->tilt;
        sample.seed = options->seed;
        phantom::writeSamplePatient(options->out, sample, context.progress());
        const std::filesystem::path out(options->out);
        context.print("The sample patient is in " + options->out +
                      ": ct, mr, labels, meshes, truth.json");
        context.printJson({{"out", out.string()},
                           {"ct", (out / "ct").string()},
                           {"mr", (out / "mr").string()},
                           {"labels", (out / "labels.seg.nrrd").string()},
                           {"truth", (out / "truth.json").string()}});
      });
  command->add_option("OUT", options->out, "Folder to write; new or empty")->required();
  command->add_option("--spacing", options->spacing, "Voxel size of the CT (0.3)")
      ->type_name("MM")
      ->check(within(phantom::SampleOptions::kSpacings));
  command->add_option("--dims", options->dims, "Voxels of the CT along x,y,z")->type_name("I,J,K");
  command->add_option("--noise", options->noise, "Standard deviation of the noise (20)")
      ->type_name("HU")
      ->check(within(phantom::SampleOptions::kNoises));
  command->add_option("--tilt", options->tilt, "Gantry tilt of the CT (0)")
      ->type_name("DEGREES")
      ->check(within(phantom::SampleOptions::kTilts));
  command->add_option("--seed", options->seed, "The same seed gives the same files (1)")
      ->type_name("N")
      ->transform(wholeNumber(0, std::numeric_limits<std::uint64_t>::max()));
}

} // namespace petrous::cli
