// Stand-in of OpenHaptics' libHD: the C interface of its functions that the server calls, with a
// servo thread of its own.

#include <chrono>
#include <string>

#include "StandInDevice.h"

using petrous::devices::testing::standIn;

namespace
{

struct ErrorInfo
{
  unsigned int code;
  int internalCode;
  unsigned int device;
};

constexpr unsigned int kForceOutput = 0x4000;

std::atomic<bool> running{false};
std::atomic<unsigned int (*)(void*)> callback{nullptr};
std::atomic<void*> callbackData{nullptr};
std::thread servo;

void serve()
{
  auto wake = std::chrono::steady_clock::now();
  while (running)
  {
    const auto function = callback.load();
    if (function && function(callbackData) == 0)
      callback = nullptr;
    wake += std::chrono::milliseconds(1);
    std::this_thread::sleep_until(wake);
  }
}

} // namespace

extern "C"
{
  unsigned int hdInitDevice(const char*)
  {
    if (!standIn().plugged)
    {
      standIn().error = 0x0302;
      return 0xFFFFFFFFU;
    }
    ++standIn().opened;
    return 0;
  }

  void hdDisableDevice(unsigned int)
  {
    ++standIn().closed;
  }
  void hdMakeCurrentDevice(unsigned int)
  {
  }
  void hdBeginFrame(unsigned int)
  {
    standIn().wait();
  }

  void hdEndFrame(unsigned int)
  {
    if (!standIn().plugged)
      standIn().error = 0x0302;
    ++standIn().commands;
  }

  ErrorInfo hdGetError()
  {
    return {static_cast<unsigned int>(standIn().error.exchange(0)), 0, 0};
  }
  const char* hdGetErrorString(unsigned int)
  {
    return "communication error";
  }

  void hdEnable(unsigned int capability)
  {
    if (capability == kForceOutput)
      standIn().enabled = 1;
  }

  void hdDisable(unsigned int capability)
  {
    if (capability == kForceOutput)
      standIn().enabled = 0;
  }

  unsigned char hdIsEnabled(unsigned int)
  {
    return standIn().enabled && standIn().forceOff == 0 ? 1 : 0;
  }

  void hdGetIntegerv(unsigned int name, int* values)
  {
    *values = name == 0x2000 ? static_cast<int>(standIn().buttons) : 4; // else inkwell
  }

  void hdGetDoublev(unsigned int name, double* values)
  {
    switch (name)
    {
    case 0x2052:
      for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
          values[4 * column + row] = column < 3 && row < 3
                                         ? standIn().rotation[3 * row + column].load()
                                     : row < 3 ? standIn().position[row].load()
                                               : (column == 3 ? 1.0 : 0.0);
      break;
    case 0x2602:
      *values = 0.5;
      break;
    case 0x2603:
      *values = 3.3;
      break;
    default:
      *values = 0.0;
    }
  }

  void hdSetDoublev(unsigned int name, const double* values)
  {
    for (int i = 0; i < 3 && name == 0x2700; ++i)
      standIn().force[i] = standIn().enabled && standIn().plugged ? values[i] : 0.0;
  }

  const char* hdGetString(unsigned int name)
  {
    static std::string number;
    number = standIn().serial ? std::to_string(standIn().serial) : "";
    return name == 0x2504 ? number.c_str() : "Touch";
  }
  unsigned int hdCheckCalibration()
  {
    return standIn().calibrated ? 0x5000 : 0x5002;
  }
  void hdUpdateCalibration(unsigned int)
  {
  }

  void hdStartScheduler()
  {
    running = true;
    servo = std::thread(serve);
  }

  void hdStopScheduler()
  {
    running = false;
    if (servo.joinable())
      servo.join();
  }

  unsigned long hdScheduleAsynchronous(unsigned int (*function)(void*), void* data, unsigned short)
  {
    callbackData = data;
    callback = function;
    return 1;
  }

  void hdUnschedule(unsigned long)
  {
    callback = nullptr;
  }
}
