#include "petrous/Presenters/CaseRegistration.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include <Eigen/Geometry>

#include "petrous/Core/AsciiCase.h"
#include "petrous/Core/NumberText.h"
#include "petrous/Registration/LiveMetric.h"
#include "petrous/Scene/ApplyRegistration.h"

namespace petrous::presenters
{

namespace
{

using From = RegistrationRequest::From;
using Method = scene::Registration::Method;
using SceneVerdict = scene::Registration::Verdict;

std::string millimetres(double value)
{
  return core::fixedText(value, 2) + " mm";
}

void add(std::string& text, const std::string& sentence)
{
  if (sentence.empty())
    return;
  text += (text.empty() ? "" : " ") + sentence;
  char& first = text[text.size() - sentence.size()];
  first = core::asciiUpper(first);
  if (text.back() != '.')
    text += '.';
}

// The registration problem: from the MR to the CT, or to the MR given by `onto`.
struct Task
{
  const scene::ImagePart* fixed = nullptr;
  const scene::ImagePart* mr = nullptr;
  core::RigidTransform fixedFromCt;
  bool commonFrame = false;
  Method method = Method::MutualInformation;
  bool fitted = false; ///< the start is already the result of a fit
  registration::FitOptions options;
  std::string statusMessage; ///< about the start, for the surgeon

  core::RigidTransform fromCt(const core::RigidTransform& mrFromFixed) const
  {
    return mrFromFixed * fixedFromCt;
  }
};

const scene::ImagePart& mrNamed(const scene::Case& value, const std::string& name)
{
  if (const scene::ImagePart* mr = scene::findMr(value, name))
    return *mr;
  std::string there;
  for (const scene::ImagePart& mr : value.mr)
    there += (there.empty() ? "" : ", ") + mr.name;
  throw core::InvalidParameter("case '" + value.name + "' has no MR '" + name + "'; " +
                               (there.empty() ? "it has none" : "it has " + there));
}

core::PatientBox moved(const core::PatientBox& box, const core::RigidTransform& transform)
{
  core::PatientBox result;
  for (int corner = 0; corner < 8; ++corner)
    result.extend(transform * box.corner(static_cast<core::PatientBox::CornerType>(corner)));
  return result;
}

void begin(Task& task, const core::RigidTransform& mrFromCt, Method method)
{
  task.method = method;
  task.options.start = registration::Start::Given;
  task.options.given = mrFromCt * task.fixedFromCt.inverse();
  task.options.search = false; // the start is known better than by search
}

Task taskOf(const scene::Case& value, const RegistrationRequest& request)
{
  Task task;
  task.mr = &mrNamed(value, request.mr);
  task.fixed = &value.ct;
  if (!request.onto.empty())
  {
    task.fixed = &mrNamed(value, request.onto);
    if (task.fixed == task.mr)
      throw core::InvalidParameter("MR '" + request.mr + "' cannot be registered to itself");
    if (!task.fixed->registered)
      throw core::InvalidParameter("MR '" + request.onto +
                                   "' is not registered with the CT; register it first");
    scene::checkThrough(value, request.mr, request.onto);
    task.fixedFromCt = task.fixed->mrFromCt;
  }
  const auto liesAsStated = [](const scene::ImagePart& image)
  { return image.provenance.axes.isIdentity(); };
  task.commonFrame = liesAsStated(*task.mr) && liesAsStated(*task.fixed) &&
                     !task.mr->frameOfReference.empty() &&
                     task.mr->isFrameSalted == task.fixed->isFrameSalted &&
                     task.mr->frameOfReference == task.fixed->frameOfReference;
  task.options.seed = request.seed;
  if (request.region)
    task.options.region = moved(*request.region, task.fixedFromCt);
  switch (request.from)
  {
  case From::Landmarks:
  {
    const auto fit = registration::fitLandmarks(request.landmarks);
    begin(task, fit.mrFromCt, Method::Landmarks);
    const auto worst = std::max_element(fit.residuals.begin(), fit.residuals.end());
    task.statusMessage = "The " + std::to_string(fit.residuals.size()) + " landmarks agree to " +
                         millimetres(fit.rms) + " (root mean square; pair " +
                         std::to_string(worst - fit.residuals.begin() + 1) + " least, " +
                         millimetres(*worst) + ").";
    break;
  }
  case From::Given:
    begin(task, request.given, request.givenBy ? request.givenBy->method : Method::ByHand);
    task.fitted = request.givenBy && request.givenBy->refined;
    if (request.lookAround)
    {
      task.options.search = true;
      task.method = Method::MutualInformation; // which then determines the pose
    }
    break;
  case From::Centres:
    task.options.start = registration::Start::Centres;
    break;
  case From::Header:
    if (task.commonFrame)
      begin(task, task.fixedFromCt, Method::FrameOfReference);
    break;
  }
  return task;
}

const char* startWords(Method method)
{
  return method == Method::Landmarks           ? "where the landmarks put it"
         : method == Method::FrameOfReference  ? "where the common frame of reference puts it"
         : method == Method::MutualInformation ? "where it lay"
                                               : "where it was put by hand";
}

// Compares start and fit at the place.
void compare(const Task& task, const registration::Registration& fit, const RegistrationPlace& at,
             scene::Registration& how)
{
  if (task.method == Method::MutualInformation || task.fitted)
    return;
  const Eigen::Vector3d point = task.fixedFromCt * at.point;
  const double apart = (task.options.given * point - fit.fit.mrFromCt * point).norm();
  std::string sentence = "The fit lies " + millimetres(apart) + " from " + startWords(task.method) +
                         ", at " + at.words;
  const double most = std::max(fit.error.p95, fit.error.max);
  const bool contradicts = task.method == Method::FrameOfReference && apart > most;
  if (contradicts)
  {
    sentence += ", which is more than the fit's error (at most " + millimetres(most) +
                "): the patient moved between the two images, or one of them misleads";
    how.verdict = SceneVerdict::Doubtful;
  }
  add(how.text, sentence + ".");
}

std::optional<scene::RegistrationError> errorOf(const registration::LocalError& error,
                                                const RegistrationPlace& at)
{
  if (!std::isfinite(error.median + error.p95 + error.max))
    return std::nullopt;
  return scene::RegistrationError{at.point,  at.words,  error.median,
                                  error.p95, error.max, error.spread};
}

// Combines both registrations.
void chain(const Task& task, scene::Registration& how)
{
  const std::string& onto = task.fixed->name;
  how.through = onto;
  const auto& first = task.fixed->registration;
  if (!first || !first->error)
  {
    how.error.reset();
    how.verdict = SceneVerdict::Doubtful;
    add(how.text,
        "How well '" + onto + "' lies on the CT is not known, so the error is not either.");
    return;
  }
  if (how.error)
  {
    how.error = chained(*how.error, *first->error, task.fixedFromCt);
    add(how.text, "The error is that of both ways: to '" + onto + "', and from there to the CT (" +
                      millimetres(first->error->p95) + " (p95) at " + first->error->place + ").");
  }
  if (first->verdict != SceneVerdict::Good)
  {
    how.verdict = SceneVerdict::Doubtful;
    add(how.text, "That '" + onto + "' lies right on the CT is not sure.");
  }
}

void layAsIs(const Task& task, const RegistrationRequest& request, RegistrationOutcome& outcome)
{
  if (task.options.start != registration::Start::Given)
    throw core::InvalidParameter(
        "MR '" + request.mr +
        "' cannot be laid as it is: it has no frame of reference in common "
        "with " +
        (request.onto.empty() ? std::string("the CT") : "'" + request.onto + "'") +
        ", and neither landmarks nor a transform are given");
  outcome.mrFromCt = task.fromCt(task.options.given);
  outcome.fit.mrFromCt = task.options.given;
  try
  {
    outcome.fit.metric = registration::LiveMetric(*task.fixed->volume.get(), *task.mr->volume.get(),
                                                  task.options.region)
                             .at(task.options.given);
    outcome.how.metric = outcome.fit.metric;
  }
  catch (const core::InvalidParameter&) // a featureless image can still be registered by hand
  {
  }
  outcome.how.verdict = SceneVerdict::Doubtful;
  add(outcome.how.text, std::string("It lies ") + startWords(task.method) +
                            ", without a fit: its error is not known.");
}

} // namespace

scene::RegistrationError chained(const scene::RegistrationError& second,
                                 const scene::RegistrationError& first,
                                 const core::RigidTransform& bFromA)
{
  scene::RegistrationError both = second;
  scene::RegistrationError there = first; // at the second's point
  if (first.spread)
  {
    const Eigen::Matrix3d moments = core::displacementMoments(*first.spread, second.point);
    there.median = core::lengthQuantile(moments, core::kNormalMedian);
    there.p95 = core::lengthQuantile(moments, core::kNormal95);
    there.max = std::max(first.max, core::lengthQuantile(moments, core::kNormal999));
  }
  both.max = second.max + there.max;
  if (!second.spread || !first.spread)
  {
    both.median = std::hypot(second.median, there.median);
    both.p95 = std::hypot(second.p95, there.p95);
    both.spread.reset();
    return both;
  }
  both.spread =
      core::takenAbout(core::chained(*second.spread, *first.spread, bFromA), second.point);
  const Eigen::Matrix3d moments = both.spread->moments.topLeftCorner<3, 3>();
  both.median = core::lengthQuantile(moments, core::kNormalMedian);
  both.p95 = core::lengthQuantile(moments, core::kNormal95);
  return both;
}

std::vector<std::string> ontoNames(const scene::Case& value, const std::string& mr)
{
  std::vector<std::string> names;
  for (const scene::ImagePart& other : value.mr)
    if (other.name != mr && other.registered && !scene::liesThrough(value, other.name, mr))
      names.push_back(other.name);
  return names;
}

RegistrationOutcome registerMr(const scene::Case& value, const RegistrationRequest& request,
                               const core::Progress& progress,
                               const registration::MetricListener& listener)
{
  const Task task = taskOf(value, request);
  RegistrationOutcome outcome;
  outcome.how.method = task.method;
  outcome.how.isFromFile =
      task.method == Method::ByHand && request.givenBy && request.givenBy->isFromFile;
  outcome.how.text = task.statusMessage;
  outcome.grid = task.mr->geometry;
  outcome.onto = request.onto;
  if (!request.onto.empty())
    outcome.ontoGrid = task.fixed->geometry;
  if (request.asIs)
  {
    layAsIs(task, request, outcome);
    if (!request.onto.empty())
      chain(task, outcome.how);
    return outcome;
  }
  progress.report(0.0, "reading the images");
  const auto fixed = task.fixed->volume.get();
  const auto moving = task.mr->volume.get();
  const RegistrationPlace at = request.at                    ? *request.at
                               : request.atStructure.empty() ? defaultPlace(value, request)
                                                             : placeOf(value, request.atStructure);
  registration::MetricListener composed;
  if (listener)
    composed = [&](const registration::MetricSample& sample, const core::RigidTransform& best)
    { listener(sample, task.fromCt(best)); };
  const registration::Registration result = registration::registerRigid(
      *fixed, *moving, task.options, task.fixedFromCt * at.point, progress, composed);

  outcome.fit = result.fit;
  outcome.estimateSeconds = result.estimateSeconds;
  outcome.mrFromCt = task.fromCt(result.fit.mrFromCt);
  outcome.failed = result.verdict == registration::Verdict::Failed;
  scene::Registration& how = outcome.how;
  how.refined = task.method != Method::MutualInformation;
  how.verdict =
      result.verdict == registration::Verdict::Good ? SceneVerdict::Good : SceneVerdict::Doubtful;
  add(how.text, result.text);
  if (std::isfinite(result.fit.metric))
    how.metric = result.fit.metric;
  how.error = errorOf(result.error, at);
  if (outcome.failed)
    return outcome;
  compare(task, result, at, how);
  if (!request.onto.empty())
    chain(task, how);
  return outcome;
}

void accept(scene::Case& value, const std::string& mr, const RegistrationOutcome& outcome)
{
  if (!outcome.failed)
    scene::applyRegistration(value, mr, outcome.mrFromCt, outcome.how);
}

} // namespace petrous::presenters
