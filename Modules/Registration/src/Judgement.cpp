#include <cstdio>

#include "Evidence.h"

namespace petrous::registration
{

namespace
{

// Set on simulated pairs, right and wrong ones: Documentation/adr.
constexpr double kLeastOverlap = 0.25;
constexpr double kLeastInformation = 0.05; // nats
constexpr double kLostStrays = 0.5;
constexpr double kSomeStrays = 0.15;
constexpr double kRival = 0.95;
constexpr double kMirror = 0.97;
constexpr double kWide = 0.9;  // mm, of the p95
constexpr double kAside = 0.6; // mm
// mm from every start. The search looks 26 mm along each axis and 42 degrees about them: what ends
// further off and is not beyond doubt came to lie there by chance.
constexpr double kFar = 50.0;

template <class... Numbers>
std::string text(const char* format, Numbers... numbers)
{
  char line[256];
  std::snprintf(line, sizeof line, format, numbers...);
  return line;
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

Judgement judge(const Evidence& e)
{
  if (e.overlap < kLeastOverlap)
    return {Verdict::Failed, text("the images share too little: %.0f %% of the smaller one's field",
                                  100.0 * e.overlap)};
  if (e.information < kLeastInformation)
    return {Verdict::Failed,
            text("the images tell next to nothing about each other (%.3f nats)", e.information)};
  if (e.strays > kLostStrays)
    return {Verdict::Failed,
            text("%.0f %% of the repeated fits ended elsewhere", 100.0 * e.strays)};

  std::string doubts;
  const auto doubt = [&doubts](const std::string& reason)
  { doubts += (doubts.empty() ? "" : "; ") + reason; };
  if (!e.pointCovered)
    doubt("the point lies outside one of the images: its error is extrapolated");
  if (e.mirrored > kMirror)
    doubt(text("the MR mirrored left to right fits as well (%.2f times the score): wrong side, or "
               "a header with the sides exchanged?",
               e.mirrored));
  if (e.runnerUp > kRival)
    doubt(text("another pose fits nearly as well (%.2f times the score)", e.runnerUp));
  if (e.strays > kSomeStrays)
    doubt(text("%.0f %% of the repeated fits ended elsewhere", 100.0 * e.strays));
  if (e.error.p95 > kWide && !e.displaced)
    doubt(text("the error may reach %.1f mm", e.error.p95));
  if (e.displaced)
    doubt(
        text("what lies within %.0f mm of the point fits %.1f mm beside the rest: it is displaced "
             "or the images are distorted there, and the error counts from where it lies",
             e.displaced->radius, e.displaced->offset.norm()));
  else if (e.aside > kAside)
    doubt(text("what lies about the point alone fits %.1f mm beside: the images differ by more "
               "than a rigid motion",
               e.aside));
  if (!doubts.empty() && e.moved > kFar)
    return {Verdict::Failed, text("the fit ended %.0f mm from where it began: ", e.moved) + doubts};
  if (!doubts.empty())
    return {Verdict::Doubtful, doubts};
  return {Verdict::Good,
          text("repeated fits agree; 95 of 100 errors are below %.2f mm", e.error.p95)};
}

} // namespace petrous::registration
