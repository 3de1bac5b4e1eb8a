#include <algorithm>
#include <functional>

#include "RegistrationBenchmark.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Registration/Register.h"

namespace petrous::registration
{

namespace
{

using Points = std::vector<core::BenchmarkPoint>;

std::string words(double value)
{
  return core::generalText(value);
}

// A schedule setting and its values; the default is among them.
struct Knob
{
  const char* name;
  std::vector<double> values;
  double (*get)(const Schedule&);
  void (*set)(Schedule&, double);
  bool displaced; // evaluated from displaced starts: concerns the capture range
};

const std::vector<Knob>& knobs()
{
  static const std::vector<Knob> all{
      {"samples",
       {2500, 5000, 10000, 20000, 40000, 80000, 160000},
       [](const Schedule& s) { return static_cast<double>(s.samples); },
       [](Schedule& s, double v) { s.samples = static_cast<std::size_t>(v); },
       false},
      {"bins",
       {8, 16, 24, 32, 48, 64, 96},
       [](const Schedule& s) { return static_cast<double>(s.bins); },
       [](Schedule& s, double v) { s.bins = static_cast<int>(v); },
       false},
      {"evaluations",
       {4, 8, 12, 20, 40, 80},
       [](const Schedule& s) { return static_cast<double>(s.evaluations); },
       [](Schedule& s, double v) { s.evaluations = static_cast<int>(v); },
       false},
      {"levels",
       {0, 1, 2, 3, 4},
       [](const Schedule& s) { return static_cast<double>(s.levels); },
       [](Schedule& s, double v) { s.levels = static_cast<int>(v); },
       false},
      {"search_samples",
       {250, 500, 1000, 2000, 4000, 8000, 16000},
       [](const Schedule& s) { return static_cast<double>(s.searchSamples); },
       [](Schedule& s, double v) { s.searchSamples = static_cast<std::size_t>(v); },
       true}};
  return all;
}

core::BenchmarkPoint judged(const std::vector<RegistrationPair>& pairs, const Knob& knob,
                            double value)
{
  FitOptions options;
  knob.set(options.schedule, value);
  std::vector<double> errors, seconds;
  double lost = 0.0;
  for (std::size_t n = 0; n < pairs.size(); ++n)
    for (std::uint32_t seed = 1; seed <= 2; ++seed)
    {
      options.seed = seed;
      const RegistrationPair pair =
          knob.displaced ? displaced(pairs[n], randomMotion(pairs[n].mr->geometry().center(), 30.0,
                                                            30.0, 70 + 10 * n + seed))
                         : pairs[n];
      const Fit fit = fitRigid(*pair.ct, *pair.mr, options);
      const double error = errorOf(pair, fit.mrFromCt).target;
      errors.push_back(error);
      seconds.push_back(fit.seconds);
      lost += error > 2.0 ? 1.0 : 0.0;
    }
  core::BenchmarkPoint point;
  point.scene = "schedule";
  point.series = knob.name;
  point.setting[knob.name] = words(value);
  point.isDefault = value == knob.get(Schedule{});
  // The mean is sensitive to a lost basin of attraction; the median is not.
  for (const double error : errors)
    point.error += error / static_cast<double>(errors.size());
  point.errorUnit = "mm at the target, mean";
  point.seconds = quantile(seconds, 0.5);
  point.extra = {{"median_mm", quantile(errors, 0.5)},
                 {"worst_mm", quantile(errors, 1.0)},
                 {"over_2mm", lost},
                 {"fits", static_cast<double>(errors.size())}};
  return point;
}

// An image property and its values.
struct Condition
{
  const char* name;
  std::vector<double> values;
  void (*apply)(PairRecipe&, const SimulationBody&, double);
};

const std::vector<Condition>& conditions()
{
  static const std::vector<Condition> all{
      {"noise",
       {0.0, 0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.4},
       [](PairRecipe& r, const SimulationBody&, double v) { r.acquisition.noise = v; }},
      {"slice_mm",
       {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0},
       [](PairRecipe& r, const SimulationBody&, double v) { r.acquisition.spacing[2] = v; }},
      {"overlap",
       {0.1, 0.15, 0.2, 0.3, 0.5, 0.7, 1.0},
       [](PairRecipe& r, const SimulationBody& body, double v)
       {
         // Common fraction of the heights of MR and CT: the CT's upper end, the MR's lower one.
         const auto bounds = body.ct->geometry().patientBounds();
         const Vector3d size = bounds.sizes();
         const double height = size[2] / (2.0 - v);
         r.ctExtent = Vector3d(size[0], size[1], height);
         r.ctCenter = bounds.center();
         r.ctCenter[2] = bounds.min()[2] + 0.5 * height;
         r.acquisition.axes.setIdentity();
         r.acquisition.extent[2] = height;
         r.acquisition.center[2] = bounds.max()[2] - 0.5 * height;
       }}};
  return all;
}

} // namespace

Points schedulePoints(const BenchmarkInput& input, const core::Progress& progress)
{
  Points points;
  for (const Knob& knob : knobs())
    for (const double value : knob.values)
    {
      if (input.quick && value != knob.get(Schedule{}) && value != knob.values[1])
        continue;
      progress.report(static_cast<double>(points.size()) / 32.0,
                      std::string("schedule: ") + knob.name);
      points.push_back(judged(input.tuning, knob, value));
    }
  return points;
}

Points conditionPoints(const BenchmarkInput& input, const core::Progress& progress)
{
  const std::size_t count = input.quick ? 1 : 6;
  Points points;
  for (const Condition& condition : conditions())
    for (const double value : condition.values)
    {
      if (input.quick && value != condition.values[3])
        continue;
      progress.report(static_cast<double>(points.size()) / 22.0,
                      std::string("error against ") + condition.name);
      std::vector<double> errors, seconds, stated;
      double good = 0.0, wrong = 0.0;
      for (std::size_t n = 0; n < count; ++n)
      {
        const SimulationBody& body = input.bodies[n % input.bodies.size()];
        PairRecipe recipe = usualRecipe(body, n, 300 + n);
        condition.apply(recipe, body, value);
        const RegistrationPair pair = simulatePair(body, n, recipe);
        const Registration result = registerRigid(*pair.ct, *pair.mr, {}, pair.targets.front());
        errors.push_back(errorOf(pair, result.fit.mrFromCt).target);
        seconds.push_back(result.fit.seconds);
        stated.push_back(result.error.p95);
        good += result.verdict == Verdict::Good ? 1.0 : 0.0;
        wrong += result.verdict == Verdict::Good && errors.back() > 2.0 ? 1.0 : 0.0;
      }
      core::BenchmarkPoint point;
      point.scene = std::string("conditions: ") + condition.name;
      point.setting[condition.name] = words(value);
      point.seconds = quantile(seconds, 0.5);
      point.error = quantile(errors, 0.5);
      point.errorUnit = "mm at the target, median";
      point.extra = {{"worst_mm", quantile(errors, 1.0)},
                     {"stated_p95_mm", quantile(stated, 0.5)},
                     {"good", good},
                     {"good_over_2mm", wrong},
                     {"pairs", static_cast<double>(count)}};
      points.push_back(std::move(point));
    }
  return points;
}

} // namespace petrous::registration
