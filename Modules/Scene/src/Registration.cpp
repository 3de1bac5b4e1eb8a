#include "petrous/Scene/Registration.h"

#include <array>
#include <utility>

#include "petrous/Core/Error.h"

namespace petrous::scene
{

namespace
{

using Method = Registration::Method;
using Verdict = Registration::Verdict;

constexpr std::array<std::pair<Method, const char*>, 4> kMethods{
    {{Method::MutualInformation, "mutual information"},
     {Method::Landmarks, "landmarks"},
     {Method::ByHand, "by hand"},
     {Method::FrameOfReference, "common frame of reference"}}};

constexpr std::array<std::pair<Verdict, const char*>, 3> kVerdicts{
    {{Verdict::NotJudged, "not judged"}, {Verdict::Good, "good"}, {Verdict::Doubtful, "doubtful"}}};

template <class Names, class Value>
const char* nameIn(const Names& names, Value value) noexcept
{
  for (const auto& [known, name] : names)
    if (known == value)
      return name;
  return "";
}

template <class Names>
auto valueIn(const Names& names, const std::string& asked, const char* what)
{
  for (const auto& [value, name] : names)
    if (name == asked)
      return value;
  throw core::InvalidParameter(std::string("registration: there is no ") + what + " '" + asked +
                               "'");
}

} // namespace

const char* nameOf(Method method) noexcept
{
  return nameIn(kMethods, method);
}

const char* nameOf(Verdict verdict) noexcept
{
  return nameIn(kVerdicts, verdict);
}

Method methodFromName(const std::string& name)
{
  return valueIn(kMethods, name, "method");
}

Verdict verdictFromName(const std::string& name)
{
  return valueIn(kVerdicts, name, "verdict");
}

std::string methodToString(const Registration& registration)
{
  const bool hand = registration.method == Registration::Method::ByHand;
  std::string words = !hand                     ? nameOf(registration.method)
                      : registration.isFromFile ? "the transform of a file"
                                                : "hand";
  if (registration.refined)
    words += ", refined by mutual information";
  if (!registration.through.empty())
    words += ", through '" + registration.through + "'";
  return words;
}

} // namespace petrous::scene
