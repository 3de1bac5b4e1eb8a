#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "CaseJson.h"
#include "CaseWarnings.h"
#include "Commands.h"
#include "Context.h"
#include "Numbers.h"
#include "petrous/Core/CsvTable.h"
#include "petrous/Core/InputFile.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Core/RigidTransform.h"
#include "petrous/Presenters/CaseRegistration.h"
#include "petrous/Registration/Landmarks.h"
#include "petrous/Scene/ApplyRegistration.h"
#include "petrous/Scene/Placement.h"
#include "petrous/Session/DrillSession.h"

namespace petrous::cli
{

namespace
{

using From = presenters::RegistrationRequest::From;

std::vector<double> numbersIn(std::string text)
{
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (json.is_object() && json.contains("transform") && json["transform"].is_array())
  {
    std::vector<double> numbers;
    for (const auto& number : json["transform"])
      if (number.is_number())
        numbers.push_back(number.get<double>());
    return numbers;
  }
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == ',' || c == ';' || c == '[' || c == ']'; },
      ' ');
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string word; stream >> word;)
  {
    const auto number = core::parseDouble(word);
    if (!number)
      return {};
    numbers.push_back(*number);
  }
  return numbers;
}

// Landmark pairs, CSV ct_x,ct_y,ct_z,mr_x,mr_y,mr_z in patient LPS mm, that determine a rigid
// transform. Throws InvalidParameter naming file and line.
std::vector<registration::LandmarkPair> readLandmarks(const std::string& path)
{
  std::ifstream file = core::openInput(path, kLargestInput);
  std::vector<registration::LandmarkPair> pairs;
  core::readCsv(file, path, {"ct_x", "ct_y", "ct_z", "mr_x", "mr_y", "mr_z"},
                [&pairs](std::size_t, const std::vector<double>& v) {
                  pairs.push_back({{v[0], v[1], v[2]}, {v[3], v[4], v[5]}});
                });
  try
  {
    registration::fitLandmarks(pairs);
  }
  catch (const core::InvalidParameter& error)
  {
    throw core::InvalidParameter(path + ": " + error.what());
  }
  return pairs;
}

// X_MC from a file: 16 numbers, row-major, or JSON with them under "transform" (as in the output
// of `petrous register --json`). Throws InvalidParameter naming the file.
core::RigidTransform readTransform(const std::string& path)
{
  const std::vector<double> numbers = numbersIn(core::readFile(path, kLargestJson));
  if (numbers.size() != 16)
    throw core::InvalidParameter(path + ": holds no transform; give 16 numbers, row by row, or "
                                        "JSON with them under \"transform\"");
  Eigen::Matrix4d matrix;
  for (int n = 0; n < 16; ++n)
    matrix(n / 4, n % 4) = numbers[static_cast<std::size_t>(n)];
  try
  {
    return core::RigidTransform::fromMatrix(matrix);
  }
  catch (const core::InvalidParameter& error)
  {
    throw core::InvalidParameter(path + ": " + error.what());
  }
}

struct Options
{
  std::string caseName, mr, transform, at, region, onto, signOff;
  std::vector<std::string> init;
  bool asIs = false;
  std::uint32_t seed = 1;
  bool seedGiven = false;
};

void setStart(const Options& options, presenters::RegistrationRequest& request)
{
  if (!options.transform.empty())
  {
    if (!options.init.empty())
      throw UsageError("register: --init and --transform both say where to begin; give one");
    request.from = From::Given;
    request.given = readTransform(options.transform);
    request.givenBy.emplace();
    request.givenBy->method = scene::Registration::Method::ByHand;
    request.givenBy->isFromFile = true;
    return;
  }
  const std::string how = options.init.empty() ? "header" : options.init.front();
  const std::size_t words = how == "landmarks" ? 2 : 1;
  if (how != "header" && how != "centres" && how != "landmarks")
    throw UsageError("--init: header, centres or landmarks F.csv, not '" + how + "'");
  if (options.init.size() > words)
    throw UsageError("--init " + how + ": takes no '" + options.init[1] + "'");
  if (how == "centres")
    request.from = From::Centres;
  if (how != "landmarks")
    return;
  if (options.init.size() < 2)
    throw UsageError("--init landmarks F.csv: the file is missing");
  request.from = From::Landmarks;
  request.landmarks = readLandmarks(options.init[1]);
}

presenters::RegistrationPlace placeFrom(const scene::Case& value, const std::string& at)
{
  if (std::count(at.begin(), at.end(), ',') != 2 || scene::findStructure(value, at))
    return presenters::placeOf(value, at);
  const auto numbers = parseNumbers(at, 3, "--at x,y,z");
  return presenters::placeAt(value, {numbers[0], numbers[1], numbers[2]});
}

presenters::RegistrationRequest requestFrom(const Options& options, const scene::Case& value)
{
  presenters::RegistrationRequest request;
  request.mr = options.mr;
  request.onto = options.onto;
  request.asIs = options.asIs;
  request.seed = options.seed;
  setStart(options, request);
  if (!options.region.empty())
    request.region = parseBox(options.region, "--region");
  if (!options.at.empty())
    request.at = placeFrom(value, options.at);
  return request;
}

nlohmann::json orNull(const std::optional<double>& value)
{
  return value && std::isfinite(*value) ? nlohmann::json(*value) : nlohmann::json();
}

// The specified keys, and additional ones.
nlohmann::json answerJson(const scene::Case& value, const std::string& mr,
                          const core::RigidTransform& transform, const scene::Registration& how,
                          const char* verdict)
{
  nlohmann::json error{{"median", nullptr}, {"p95", nullptr}, {"max", nullptr}};
  if (how.error)
    error = {{"median", how.error->median},
             {"p95", how.error->p95},
             {"max", how.error->max},
             {"at_mm", vectorJson(how.error->point)},
             {"place", how.error->place}};
  const scene::ImagePart& image = *scene::findMr(value, mr);
  nlohmann::json signedOff;
  if (const scene::SignOff* signOff = scene::validSignOff(image))
    signedOff = signOffJson(*signOff);
  return {{"case", value.name},
          {"mr", mr},
          {"registered", image.registered},
          {"transform", transformJson(transform)},
          {"metric", orNull(how.metric)},
          {"error_mm", std::move(error)},
          {"verdict", verdict},
          {"text", how.text},
          {"method", nameOf(how.method)},
          {"refined", how.refined},
          {"through", how.through.empty() ? nlohmann::json() : nlohmann::json(how.through)},
          {"signed_off", std::move(signedOff)},
          {"resources", residentResources(value)}};
}

void printError(const Context& context, const scene::Registration& how)
{
  if (how.error)
    context.print("  error at " + how.error->place + ": median " + fixed(how.error->median, 2) +
                  ", p95 " + fixed(how.error->p95, 2) + ", max " + fixed(how.error->max, 2) +
                  " mm");
}

// A sign-off is for a result that was inspected, so it excludes every other action.
void sign(const Context& context, const Options& options)
{
  if (!options.init.empty() || !options.transform.empty() || options.asIs || !options.at.empty() ||
      !options.region.empty() || !options.onto.empty() || options.seedGiven)
    throw UsageError("register: --sign-off stands alone; register, look at the result, then sign "
                     "what you saw");
  library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  scene::signOff(value, options.mr, options.signOff, session::utcNow());
  library.save(value);
  const scene::ImagePart& mr = *scene::findMr(value, options.mr);
  context.print("MR '" + mr.name + "': " + scene::registrationToString(mr));
  context.printJson(
      answerJson(value, mr.name, mr.mrFromCt, *mr.registration, nameOf(mr.registration->verdict)));
}

void printOutcome(const Context& context, const scene::Case& value, const Options& options,
                  const presenters::RegistrationOutcome& outcome, bool wasSigned)
{
  const scene::Registration& how = outcome.how;
  if (outcome.failed)
  {
    context.print("MR '" + options.mr + "': failed. " + how.text);
    context.print("  the case is as it was");
    return;
  }
  context.print("MR '" + options.mr + "' registered by " + methodToString(how) + ": " +
                nameOf(how.verdict) + ". " + how.text);
  printError(context, how);
  if (!options.asIs)
    context.print("  " + fixed(outcome.fit.seconds, 1) + " s for the fit, " +
                  fixed(outcome.estimateSeconds, 1) + " s for the error");
  if (const auto names = scene::drawnOnMr(value, options.mr); !names.empty())
    context.print("  now on the CT: " + scene::listed(names));
  warnOutdated(context, value);
  context.print(wasSigned ? "  the sign-off of the registration before is void"
                          : "  not signed off: look at it, then register --sign-off NAME");
}

void registerMr(const Context& context, const Options& options)
{
  library::Library library = context.openLibrary();
  scene::Case value = library.open(options.caseName);
  const auto request = requestFrom(options, value);
  const core::Progress progress = context.progress();
  nlohmann::json curve = nlohmann::json::array();
  const auto listener =
      [&curve](const registration::MetricSample& sample, const core::RigidTransform&)
  {
    curve.push_back({{"evaluation", sample.evaluation},
                     {"level", sample.level},
                     {"metric", orNull(sample.metric)}});
  };
  const auto outcome = presenters::registerMr(value, request, progress.part(0.0, 0.98), listener);
  context.refuseDamaged();
  const scene::ImagePart* mr = scene::findMr(value, options.mr);
  const bool wasSigned = scene::validSignOff(*mr) != nullptr;
  if (!outcome.failed)
  {
    presenters::accept(value, options.mr, outcome);
    library.save(value, progress.part(0.98, 1.0));
  }
  printOutcome(context, value, options, outcome, wasSigned);
  nlohmann::json answer = answerJson(value, options.mr, outcome.mrFromCt, outcome.how,
                                     outcome.failed ? "failed" : nameOf(outcome.how.verdict));
  answer["seconds"] = outcome.fit.seconds;
  answer["estimate_seconds"] = outcome.estimateSeconds;
  answer["iterations"] = outcome.fit.iterations;
  answer["overlap"] = orNull(outcome.fit.overlap);
  answer["curve"] = std::move(curve);
  context.printJson(answer);
}

} // namespace

void addRegisterCommand(CLI::App& app, Context& context)
{
  auto options = std::make_shared<Options>();
  CLI::App* command =
      context.addCommand(app, "register", "Lay an MR on the CT, and say how well it lies there",
                         [options, &context]
                         {
                           if (options->signOff.empty())
                             registerMr(context, *options);
                           else
                             sign(context, *options);
                         });
  command->add_option("CASE", options->caseName)->required();
  command->add_option("--mr", options->mr, "Which MR")->type_name("NAME")->required();
  command
      ->add_option("--init", options->init,
                   "Initial transform: header (default), centres, or landmarks F.csv "
                   "(ct_x,ct_y,ct_z,mr_x,mr_y,mr_z, patient LPS mm)")
      ->expected(1, 2)
      ->type_name("HOW")
      ->check(offers({"header", "centres", "landmarks"}));
  command
      ->add_option("--transform", options->transform,
                   "Initial transform from a file: 16 numbers, CT to MR patient points, LPS mm")
      ->type_name("F");
  command->add_flag("--as-is", options->asIs,
                    "No optimization: keep the transform of landmarks, file or common frame of "
                    "reference");
  command
      ->add_option("--at", options->at,
                   "Where the error is estimated: a point (LPS mm) or a structure (the middle ear)")
      ->type_name("x,y,z|LABEL");
  command->add_option("--region", options->region, "Use only this box of the CT, LPS mm")
      ->type_name("x0,x1,y0,y1,z0,z1");
  command
      ->add_option("--to", options->onto,
                   "Register to this MR, which is registered already, and through it to the CT")
      ->type_name("MR");
  CLI::Option* seed =
      command->add_option("--seed", options->seed, "The same seed gives the same result (1)")
          ->type_name("N")
          ->transform(wholeNumber(0, std::numeric_limits<std::uint32_t>::max()));
  seed->each([options](const std::string&) { options->seedGiven = true; });
  command
      ->add_option("--sign-off", options->signOff,
                   "Only record that NAME has inspected and accepts the registration")
      ->type_name("NAME");
}

} // namespace petrous::cli
