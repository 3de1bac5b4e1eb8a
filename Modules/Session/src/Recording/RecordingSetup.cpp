#include <cmath>

#include <nlohmann/json.hpp>

#include "petrous/Core/NumberText.h"
#include "petrous/Dissection/BurrName.h"
#include "petrous/Session/Recording.h"

namespace petrous::session
{

namespace
{

using nlohmann::json;

// Calls `field(name, value)` for every number of the setup, so that writing and reading are
// consistent.
template <typename Setup, typename Field>
void eachNumber(Setup& s, Field field)
{
  field("burr_diameter_mm", s.burr.diameter);
  field("burr_rpm", s.burr.rpm);
  field("degrees_of_freedom", s.degrees);
  field("scene_ct", s.scene.ct);
  field("scene_iso_hu", s.scene.iso);
  field("scene_tissue", s.scene.tissue);
  field("scene_mask", s.scene.mask);
  field("scene_strokes", s.scene.applied);
  field("scene_first_state", s.scene.firstState);
  field("stiffness_n_per_mm", s.proxy.stiffness);
  field("angular_stiffness_nmm_per_rad", s.proxy.angularStiffness);
  field("near_gap_voxels", s.proxy.nearGap);
  field("sweep_step_voxels", s.proxy.sweepStep);
  field("bisections", s.proxy.bisections);
  field("rounds", s.proxy.rounds);
  field("deadband_mm", s.proxy.deadband);
  field("samples_a_tick", s.proxy.samples);
  field("servo_stiffness_n_per_mm", s.servo.stiffness);
  field("burr_points", s.servo.burrPoints);
  field("center_x_mm", s.servo.center[0]);
  field("center_y_mm", s.servo.center[1]);
  field("center_z_mm", s.servo.center[2]);
  field("stall_after_s", s.servo.stallAfter);
  field("guard_speed_mm_s", s.servo.guard.speed);
  field("guard_angular_speed_rad_s", s.servo.guard.angularSpeed);
  field("guard_reach_mm", s.servo.guard.reach);
  field("guard_stale_after_s", s.servo.guard.staleAfter);
  field("guard_unit_tolerance", s.servo.guard.unitTolerance);
  field("guard_good_ticks", s.servo.guard.goodTicks);
  field("max_force_n", s.servo.limits.maxForce);
  field("max_torque_nmm", s.servo.limits.maxTorque);
  field("force_slew_n_s", s.servo.limits.forceSlew);
  field("torque_slew_nmm_s", s.servo.limits.torqueSlew);
  field("fade_in_s", s.servo.limits.fadeIn);
  field("fade_out_s", s.servo.limits.fadeOut);
  field("longest_step_s", s.servo.limits.maxStep);
}

template <typename Passivity, typename Field>
void eachPassivity(Passivity& p, Field field)
{
  field("passivity_allowance_nmm", p.allowance);
  field("passivity_stiffness_n_per_mm", p.stiffness);
  field("passivity_angular_stiffness_nmm_per_rad", p.angularStiffness);
  field("passivity_device_damping_n_s_per_mm", p.deviceDamping);
  field("passivity_device_angular_damping_nmm_s_per_rad", p.deviceAngularDamping);
  field("passivity_largest_damping_n_s_per_mm", p.largestDamping);
  field("passivity_lever_mm", p.lever);
}

} // namespace

std::string toString(const RecordingSetup& setup)
{
  const std::string burrNamed = dissection::nameOf(setup.burr);
  return burrNamed + " burr " + core::generalText(setup.burr.diameter, 10) + " mm, " +
         std::to_string(setup.degrees) + " degrees of freedom";
}

std::string toJson(const RecordingSetup& setup)
{
  json out;
  out["tool"] = setup.tool;
  out["note"] = setup.note;
  out["burr"] = dissection::nameOf(setup.burr.kind);
  if (!setup.burr.name.empty())
    out["burr_name"] = setup.burr.name;
  const auto put = [&out](const char* name, const auto& value)
  {
    // JSON has no infinity; it would be read back as null.
    if (!std::isfinite(static_cast<double>(value)))
      throw core::InvalidParameter(std::string("recording: ") + name + " is not a finite number");
    out[name] = value;
  };
  eachNumber(setup, put);
  if (setup.servo.passivity)
    eachPassivity(*setup.servo.passivity, put);
  try
  {
    return out.dump();
  }
  catch (const json::exception&)
  {
    throw core::InvalidParameter("recording: a text of the set-up is not UTF-8");
  }
}

RecordingSetup setupFromJson(const std::string& text)
{
  RecordingSetup setup;
  try
  {
    const json in = json::parse(text);
    setup.tool = in.at("tool").get<std::string>();
    setup.note = in.at("note").get<std::string>();
    const auto kind = dissection::parseBurrKind(in.at("burr").get<std::string>());
    if (!kind)
      throw core::InvalidParameter("recording: the set-up names an unknown burr");
    setup.burr.kind = *kind;
    dissection::setName(setup.burr, in.value("burr_name", std::string()));
    const auto get = [&in](const char* name, auto& value)
    { value = in.at(name).get<std::decay_t<decltype(value)>>(); };
    eachNumber(setup, get);
    if (in.contains("passivity_lever_mm"))
      eachPassivity(setup.servo.passivity.emplace(), get);
  }
  catch (const json::exception&) // its message quotes the file
  {
    throw core::InvalidParameter(
        "recording: the set-up cannot be read; it is damaged or of another "
        "program");
  }
  return setup;
}

} // namespace petrous::session
