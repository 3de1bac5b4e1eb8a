#include "QualityFeatures.h"

#include "petrous/Core/NumberText.h"

namespace petrous::registration
{

namespace
{

// Determined on simulated pairs, correct and incorrect ones: Documentation/adr.
constexpr double kMinOverlap = 0.25;
constexpr double kMinInformation = 0.05; // nats
constexpr double kLostStrays = 0.5;
constexpr double kSomeStrays = 0.15;
constexpr double kRival = 0.95;
constexpr double kMirror = 0.97;
constexpr double kWide = 0.9;  // mm, of the p95
constexpr double kAside = 0.6; // mm
// mm from every start. The search covers 26 mm along and 42 degrees about each axis: a fit that
// ends further off, with any doubt, got there by chance.
constexpr double kFar = 50.0;

std::string percent(double share)
{
  return core::fixedText(100.0 * share, 0) + " %";
}

} // namespace

const char* nameOf(Verdict verdict)
{
  switch (verdict)
  {
  case Verdict::Good:
    return "good";
  case Verdict::Doubtful:
    return "doubtful";
  case Verdict::Failed:
    break;
  }
  return "failed";
}

QualityVerdict judge(const QualityFeatures& e)
{
  if (e.overlap < kMinOverlap)
    return {Verdict::Failed,
            "the images share too little: " + percent(e.overlap) + " of the smaller one's field"};
  if (e.information < kMinInformation)
    return {Verdict::Failed, "the images tell next to nothing about each other (" +
                                 core::fixedText(e.information, 3) + " nats)"};
  if (e.strays > kLostStrays)
    return {Verdict::Failed, percent(e.strays) + " of the repeated fits ended elsewhere"};

  std::string doubts;
  const auto doubt = [&doubts](const std::string& reason)
  { doubts += (doubts.empty() ? "" : "; ") + reason; };
  if (!e.pointCovered)
    doubt("the point lies outside one of the images: its error is extrapolated");
  if (e.mirrored > kMirror)
    doubt("the moving image mirrored left to right fits as well (" +
          core::fixedText(e.mirrored, 2) +
          " times the score): wrong side, or a header with the sides exchanged?");
  if (e.runnerUp > kRival)
    doubt("another pose fits nearly as well (" + core::fixedText(e.runnerUp, 2) +
          " times the score)");
  if (e.strays > kSomeStrays)
    doubt(percent(e.strays) + " of the repeated fits ended elsewhere");
  if (e.error.p95 > kWide && !e.displaced)
    doubt("the error may reach " + core::fixedText(e.error.p95, 1) + " mm");
  if (e.displaced)
    doubt("what lies within " + core::fixedText(e.displaced->radius, 0) + " mm of the point fits " +
          core::fixedText(e.displaced->offset.norm(), 1) +
          " mm beside the rest: it is displaced or the images are distorted there, and the error "
          "counts from where it lies");
  else if (e.aside > kAside)
    doubt("what lies about the point alone fits " + core::fixedText(e.aside, 1) +
          " mm beside: the images differ by more than a rigid motion");
  if (!doubts.empty() && e.moved > kFar)
    return {Verdict::Failed,
            "the fit ended " + core::fixedText(e.moved, 0) + " mm from where it began: " + doubts};
  if (!doubts.empty())
    return {Verdict::Doubtful, doubts};
  return {Verdict::Good, "repeated fits agree; 95 of 100 errors are below " +
                             core::fixedText(e.error.p95, 2) + " mm"};
}

} // namespace petrous::registration
