#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>

#include "Commands.h"
#include "Numbers.h"
#include "petrous/Devices/DeviceCheck.h"
#include "petrous/Devices/ServedDevice.h"
#include "petrous/Devices/ServerCatalogue.h"
#include "petrous/Presenters/DeviceLimits.h"
#include "petrous/Presenters/DeviceTestRun.h"

namespace petrous::cli
{

namespace
{

using devices::DeviceCheck;
using Stage = DeviceCheck::Stage;

constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};

struct Choice
{
  std::string name;
  std::string program; ///< instead of an installed server
  DeviceCheck::Options options;
  bool noForce = false;
  bool keep = false;
};

devices::ServedDevice::Options serverFor(const Choice& choice)
{
  devices::ServedDevice::Options options;
  if (!choice.program.empty())
  {
    const std::filesystem::path program = std::filesystem::absolute(choice.program);
    options.name = choice.name.empty() ? "test" : choice.name;
    options.command = {program.string()};
    return options;
  }
  const auto servers = devices::findServers(devices::serverFolders());
  std::string names;
  for (const devices::FoundServer& server : servers)
    names += (names.empty() ? "" : ", ") + server.name;
  const auto found = std::find_if(servers.begin(), servers.end(),
                                  [&choice](const devices::FoundServer& server)
                                  { return server.name == choice.name; });
  if (servers.empty())
    throw core::InvalidParameter("no device server is installed; Documentation/devices.md says "
                                 "how to install one");
  if (choice.name.empty() && servers.size() > 1)
    throw UsageError("device-test: name one of the installed device servers: " + names);
  if (!choice.name.empty() && found == servers.end())
    throw core::InvalidParameter("no device server '" + choice.name +
                                 "' is installed; there are: " + names);
  const devices::FoundServer& server = choice.name.empty() ? servers.front() : *found;
  options.name = server.name;
  options.command = {server.program.string()};
  return options;
}

// s; the q-quantile of the round trips, 0 if there are none.
double quantile(std::vector<double> values, double q)
{
  if (values.empty())
    return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

DeviceCheck::Result run(Context& context, devices::ServedDevice& device,
                        const DeviceCheck::Options& options)
{
  const core::Progress progress = context.progress();
  std::optional<Stage> told;
  return presenters::testDevice(
      device, options,
      [&](const DeviceCheck& check)
      {
        // Not anew for each axis, while it rests.
        if (check.stage() != told && check.stage() != Stage::Done &&
            !(check.stage() == Stage::Rest && told == Stage::ForceStep))
        {
          told = check.stage();
          context.print(presenters::deviceTestAdvice(check));
        }
        progress.report(check.progress(), presenters::deviceTestAdvice(check)); // or cancelled
      });
}

nlohmann::json vectorJson(const Eigen::Vector3d& v)
{
  return {v.x(), v.y(), v.z()};
}

nlohmann::json answer(const devices::ServedDevice& device, const DeviceCheck::Result& result,
                      bool forces, const std::vector<std::string>& asked, bool kept)
{
  const haptics::DeviceDescription& description = device.description();
  const double proposed = presenters::boundedStiffness(result.proposed, description.maxStiffness);
  nlohmann::json axes = nlohmann::json::array();
  for (std::size_t i = 0; i < 3 && forces; ++i)
  {
    const DeviceCheck::Axis& axis = result.axes[i];
    axes.push_back({{"axis", kAxes[i]},
                    {"step_moved_mm", vectorJson(axis.moved)},
                    {"step_latency_ms", 1000.0 * axis.latency},
                    {"follows", axis.follows},
                    {"stable_n_per_mm", axis.stable},
                    {"limit_n_per_mm",
                     axis.limit > 0.0 ? nlohmann::json(axis.limit) : nlohmann::json(nullptr)},
                    {"limit_by_fault", axis.faulted},
                    {"limit_cycle_hz",
                     axis.hertz > 0.0 ? nlohmann::json(axis.hertz) : nlohmann::json(nullptr)}});
  }
  const auto text = [](const std::string& words)
  { return words.empty() ? nlohmann::json(nullptr) : nlohmann::json(words); };
  return {
      {"device", description.name},
      {"senses_rotation", description.sensesRotation},
      {"gives_force", description.givesForce},
      {"gives_torque", description.givesTorque},
      {"max_force_n", description.maxForce},
      {"described_stiffness_n_per_mm", description.maxStiffness},
      {"asked", asked},
      {"problem", text(result.problem)},
      {"last_fault", text(device.status().lastFault)},
      {"faults", result.faults},
      {"workspace_mm", {{"min", vectorJson(result.lowest)}, {"max", vectorJson(result.highest)}}},
      {"turned_rad", result.turned},
      {"buttons", result.buttons},
      {"pedal", result.pedal},
      {"rate_hz", result.rate},
      {"worst_gap_ms", 1000.0 * result.worstGap},
      {"round_trip_ms",
       {{"p50", 1000.0 * quantile(result.roundTrips, 0.5)},
        {"p99", 1000.0 * quantile(result.roundTrips, 0.99)},
        {"max", 1000.0 * quantile(result.roundTrips, 1.0)}}},
      {"axes", std::move(axes)},
      {"proposed_stiffness_n_per_mm",
       proposed > 0.0 ? nlohmann::json(proposed) : nlohmann::json(nullptr)},
      {"kept", kept}};
}

void printResult(const Context& context, const DeviceCheck::Result& result, bool forces)
{
  const auto range = [&](int axis)
  { return fixed(result.lowest[axis], 0) + " to " + fixed(result.highest[axis], 0); };
  context.print("workspace   x " + range(0) + ", y " + range(1) + ", z " + range(2) + " mm");
  context.print("rate        " + fixed(result.rate, 0) + " readings/s, longest gap " +
                fixed(1000.0 * result.worstGap, 1) + " ms");
  if (!forces)
    return;
  context.print("round trip  " + fixed(1000.0 * quantile(result.roundTrips, 0.5), 2) +
                " ms, 99 of 100 within " + fixed(1000.0 * quantile(result.roundTrips, 0.99), 2) +
                " ms");
  for (std::size_t i = 0; i < 3; ++i)
  {
    const DeviceCheck::Axis& axis = result.axes[i];
    const std::string title = std::string("axis ") + kAxes[i] + "      ";
    if (!axis.follows)
      context.print(title + "does NOT follow the force: it moved by " + fixed(axis.moved.x(), 1) +
                    ", " + fixed(axis.moved.y(), 1) + ", " + fixed(axis.moved.z(), 1) +
                    " mm; no spring was tried");
    else
      context.print(title + "follows the force after " + fixed(1000.0 * axis.latency, 1) +
                    " ms; stable up to " + fixed(axis.stable, 2) + " N/mm" +
                    (axis.limit > 0.0 ? (axis.faulted ? ", a fault at " : ", oscillates at ") +
                                            fixed(axis.limit, 2)
                                      : ""));
  }
  if (result.faults > 0)
    context.print("faults      " + std::to_string(result.faults) + ", as the device reported");
}

void deviceTest(Context& context, const Choice& choice)
{
  devices::ServedDevice::Options server = serverFor(choice);
  std::vector<std::string> asked;
  server.waits = [&](const std::string& text)
  {
    if (!asked.empty() && asked.back() == text)
      return;
    asked.push_back(text);
    context.warn(server.name + ": " + text);
  };
  const core::Progress progress = context.progress();
  server.wanted = [&progress]
  {
    progress.check("device-test");
    return true;
  };
  devices::ServedDevice device(server);
  DeviceCheck::Options options = choice.options;
  options.force = !choice.noForce;
  const bool forces = options.force && device.description().givesForce;
  const DeviceCheck::Result result = run(context, device, options);

  const bool follows = std::all_of(result.axes.begin(), result.axes.end(),
                                   [](const DeviceCheck::Axis& axis) { return axis.follows; });
  const double described = device.description().maxStiffness;
  const double proposed = presenters::boundedStiffness(result.proposed, described);
  const bool keep = choice.keep && result.problem.empty() && proposed > 0.0;
  if (keep)
    presenters::keepStiffness(presenters::deviceLimitsFile(), server.name,
                              device.description().name, proposed);
  printResult(context, result, forces && result.problem.empty());
  if (proposed > 0.0 && result.problem.empty())
    context.print(
        "proposed    a stiffness of " + fixed(proposed, 2) + " N/mm" +
        (proposed < result.proposed ? ", twice what its server describes" : "") +
        (keep ? ", kept for '" + server.name + "'" : "; --keep has the workstation use it"));
  if (choice.keep && !keep)
    context.warn("nothing was kept: " +
                 (!result.problem.empty() ? result.problem
                  : !forces               ? std::string("no forces were tested")
                  : !follows              ? std::string("not every axis follows its force")
                  : described <= 0.0      ? std::string("its server describes no stiffness")
                                          : std::string("no stiffness was stable")));
  context.printJson(answer(device, result, forces, asked, keep));
  if (!result.problem.empty())
    throw core::InvalidParameter("device server '" + server.name + "': " + result.problem);
}

} // namespace

void addDeviceTestCommand(CLI::App& app, Context& context)
{
  auto choice = std::make_shared<Choice>();
  CLI::App* command = context.addCommand(
      app, "device-test",
      "Test of a haptic device: workspace, rate, force along each axis, the stiffness it bears",
      [choice, &context] { deviceTest(context, *choice); });
  command->add_option("NAME", choice->name,
                      "Installed device server; not needed if there is only one");
  command->add_option("--server", choice->program, "Program of a server that is not installed")
      ->type_name("FILE");
  command
      ->add_option("--workspace", choice->options.workspaceTime,
                   "Time to move the handle through its workspace, s (default 8)")
      ->check(within({0.5, 120.0, "s"}));
  command
      ->add_option("--max-stiffness", choice->options.maxStiffness,
                   "End of the stiffness ramp, N/mm (default 10)")
      ->check(within({0.1, 20.0, "N/mm"}));
  command->add_flag("--no-force", choice->noForce, "Only workspace, rate and buttons");
  command->add_flag("--keep", choice->keep,
                    "Have the workstation use the proposed stiffness for this device");
}

} // namespace petrous::cli
