#pragma once

#include "VendorLibrary.h"

namespace petrous::devices
{

/// The functions of OpenHaptics' HD API (libHD) that the server calls, by the signatures and
/// numbers of its programmer's guide and API reference. Millimetres, newtons.
struct HdApi
{
  using Callback = unsigned int(void* data);

  struct ErrorInfo
  {
    unsigned int code = 0;
    int internalCode = 0;
    unsigned int device = 0;
  };

  enum : unsigned int
  {
    kSuccess = 0,
    kCallbackDone = 0,
    kCallbackContinue = 1,
    kInvalidHandle = 0xFFFFFFFFU,

    kWarmMotors = 0x0200,
    kForceErrors = 0x0200,  ///< to 0x02ff
    kDeviceErrors = 0x0300, ///< to 0x03ff
    kErrorFamily = 0xff00,

    kButtons = 0x2000,
    kTransform = 0x2052, ///< 16 doubles, column-major, stylus to device
    kModelType = 0x2501,
    kSerialNumber = 0x2504,
    kCalibrationStyle = 0x2555,
    kMaxStiffness = 0x2602, ///< N/mm
    kMaxForce = 0x2603,     ///< N
    kForce = 0x2700,

    kForceOutput = 0x4000,
    kMaxForceClamping = 0x4001,

    kCalibrationOk = 0x5000,
    kCalibrationNeedsUpdate = 0x5001,
    kCalibrationNeedsInput = 0x5002,

    kEncoderReset = 1, ///< calibration styles, bits
    kAuto = 2,
    kInkwell = 4
  };
  static constexpr unsigned short kDefaultPriority = 0x7fff;

  unsigned int (*initDevice)(const char* name) = nullptr;
  void (*disableDevice)(unsigned int device) = nullptr;
  void (*makeCurrent)(unsigned int device) = nullptr;
  void (*beginFrame)(unsigned int device) = nullptr;
  void (*endFrame)(unsigned int device) = nullptr;
  ErrorInfo (*getError)() = nullptr;
  const char* (*getErrorString)(unsigned int code) = nullptr;
  void (*enable)(unsigned int capability) = nullptr;
  void (*disable)(unsigned int capability) = nullptr;
  unsigned char (*isEnabled)(unsigned int capability) = nullptr;
  void (*getIntegers)(unsigned int name, int* values) = nullptr;
  void (*getDoubles)(unsigned int name, double* values) = nullptr;
  void (*setDoubles)(unsigned int name, const double* values) = nullptr;
  const char* (*getString)(unsigned int name) = nullptr;
  unsigned int (*checkCalibration)() = nullptr;
  void (*updateCalibration)(unsigned int style) = nullptr;
  void (*startScheduler)() = nullptr;
  void (*stopScheduler)() = nullptr;
  unsigned long (*scheduleAsynchronous)(Callback* callback, void* data,
                                        unsigned short priority) = nullptr;
  void (*unschedule)(unsigned long handle) = nullptr;

  void load(VendorLibrary& library)
  {
    library.load("hdInitDevice", initDevice);
    library.load("hdDisableDevice", disableDevice);
    library.load("hdMakeCurrentDevice", makeCurrent);
    library.load("hdBeginFrame", beginFrame);
    library.load("hdEndFrame", endFrame);
    library.load("hdGetError", getError);
    library.load("hdGetErrorString", getErrorString);
    library.load("hdEnable", enable);
    library.load("hdDisable", disable);
    library.load("hdIsEnabled", isEnabled);
    library.load("hdGetIntegerv", getIntegers);
    library.load("hdGetDoublev", getDoubles);
    library.load("hdSetDoublev", setDoubles);
    library.load("hdGetString", getString);
    library.load("hdCheckCalibration", checkCalibration);
    library.load("hdUpdateCalibration", updateCalibration);
    library.load("hdStartScheduler", startScheduler);
    library.load("hdStopScheduler", stopScheduler);
    library.load("hdScheduleAsynchronous", scheduleAsynchronous);
    library.load("hdUnschedule", unschedule);
  }
};

} // namespace petrous::devices
