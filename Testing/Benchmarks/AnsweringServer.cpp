#include "AnsweringServer.h"

#include <cstring>
#include <fstream>
#include <thread>

#include "DeviceServer.h"
#include "petrous/Core/Error.h"

namespace petrous::cli
{

namespace
{

constexpr std::size_t kMost = 4U << 20; // wrenches: more than an hour of them

struct Motors
{
  bool polls = false;
  std::string file;
  std::vector<Arrival> arrivals;
  std::uint64_t last = 0;
  std::thread thread;
};

std::uint32_t openMotors(void* data, petrous_device_server* server)
{
  auto& motors = *static_cast<Motors*>(data);
  const petrous_device_description description{
      "Answering", PETROUS_SENSES_ROTATION | PETROUS_GIVES_FORCE, 3.0, 0.0, 1.0, 0.0};
  petrous_device_describe(server, &description);
  if (motors.polls && !motors.thread.joinable())
    motors.thread = std::thread(
        [server]
        {
          while (petrous_device_exchange(server) != PETROUS_SERVER_NO_DEVICE)
          {
          }
        });
  return PETROUS_SERVER_READY;
}

std::uint32_t stepMotors(void* data, petrous_device_server*, const petrous_device_wrench* wrench,
                         petrous_device_pose* pose)
{
  auto& motors = *static_cast<Motors*>(data);
  const std::int64_t now = petrous_device_now();
  if (wrench->tick != motors.last && wrench->tick != 0 && motors.arrivals.size() < kMost)
    motors.arrivals.push_back({wrench->tick, now});
  motors.last = wrench->tick;
  pose->time_ns = static_cast<std::uint64_t>(now);
  pose->buttons = static_cast<std::uint32_t>(static_cast<std::uint64_t>(now) / 1000U);
  pose->rotation[0] = 1.0;
  return PETROUS_SERVER_READY;
}

void closeMotors(void* data)
{
  auto& motors = *static_cast<Motors*>(data);
  if (motors.thread.joinable())
    motors.thread.join();
  std::ofstream out(motors.file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(motors.arrivals.data()),
            static_cast<std::streamsize>(motors.arrivals.size() * sizeof(Arrival)));
}

} // namespace

std::vector<std::string> answeringServer(bool polls, const std::filesystem::path& file)
{
  return {std::filesystem::read_symlink("/proc/self/exe").string(), kAnsweringServer,
          polls ? "poll" : "tick", file.string()};
}

int serveAnswers(const std::vector<std::string>& words)
{
  if (words.size() != 4)
    return 2;
  Motors motors;
  motors.polls = words[1] == "poll";
  motors.file = words[2];
  motors.arrivals.reserve(kMost);
  const petrous_device_driver driver{"petrous-bench", &motors,     openMotors,
                                     stepMotors,      closeMotors, motors.polls ? 1 : 0};
  return petrous_device_serve(&driver, words[3].c_str());
}

std::vector<Arrival> arrivalsIn(const std::filesystem::path& file)
{
  std::ifstream in(file, std::ios::binary);
  std::vector<Arrival> arrivals;
  for (Arrival one; in.read(reinterpret_cast<char*>(&one), sizeof one);)
    arrivals.push_back(one);
  if (arrivals.empty())
    throw core::Error(core::Fault::Refused, "the device server of the benchmark had no wrenches");
  return arrivals;
}

} // namespace petrous::cli
