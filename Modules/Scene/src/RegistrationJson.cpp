#include "RegistrationJson.h"

#include "DissectionJson.h"

namespace petrous::scene
{

using nlohmann::json;

json poseOut(const core::RigidTransform& x)
{
  const auto& q = x.rotation();
  return {{"quaternion_wxyz", {q.w(), q.x(), q.y(), q.z()}},
          {"translation_mm", vectorOut(x.translation())}};
}

core::RigidTransform poseIn(const json& j)
{
  const auto q = j.at("quaternion_wxyz").get<std::array<double, 4>>();
  return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]), vectorIn(j.at("translation_mm"))};
}

namespace
{

json errorOut(const RegistrationError& error)
{
  return {{"point_mm", vectorOut(error.point)},
          {"place", error.place},
          {"median_mm", error.median},
          {"p95_mm", error.p95},
          {"max_mm", error.max}};
}

RegistrationError errorIn(const json& j)
{
  RegistrationError error;
  error.point = vectorIn(j.at("point_mm"));
  error.place = j.at("place").get<std::string>();
  error.median = j.at("median_mm").get<double>();
  error.p95 = j.at("p95_mm").get<double>();
  error.max = j.at("max_mm").get<double>();
  if (!(error.median >= 0.0 && error.p95 >= 0.0 && error.max >= 0.0))
    throw core::InvalidParameter("registration: an error below 0 mm");
  return error;
}

json signOffOut(const SignOff& signOff)
{
  return {{"who", signOff.who}, {"when", signOff.when}, {"mr_from_ct", poseOut(signOff.transform)}};
}

SignOff signOffIn(const json& j)
{
  return {j.at("who").get<std::string>(), j.at("when").get<std::string>(),
          poseIn(j.at("mr_from_ct"))};
}

} // namespace

json registrationOut(const Registration& registration)
{
  json j{{"method", nameOf(registration.method)},
         {"refined", registration.refined},
         {"verdict", nameOf(registration.verdict)},
         {"text", registration.text}};
  if (registration.metric)
    j["metric_nats"] = *registration.metric;
  if (registration.error)
    j["error"] = errorOut(*registration.error);
  if (!registration.through.empty())
    j["through"] = registration.through;
  if (registration.signOff)
    j["signed_off"] = signOffOut(*registration.signOff);
  return j;
}

Registration registrationIn(const json& j)
{
  Registration registration;
  registration.method = methodFromName(j.at("method").get<std::string>());
  registration.refined = j.at("refined").get<bool>();
  registration.verdict = verdictFromName(j.at("verdict").get<std::string>());
  registration.text = j.at("text").get<std::string>();
  if (j.contains("metric_nats"))
    registration.metric = j.at("metric_nats").get<double>();
  if (j.contains("error"))
    registration.error = errorIn(j.at("error"));
  registration.through = j.value("through", std::string());
  if (j.contains("signed_off"))
    registration.signOff = signOffIn(j.at("signed_off"));
  return registration;
}

} // namespace petrous::scene
