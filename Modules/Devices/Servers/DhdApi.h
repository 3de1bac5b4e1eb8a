#pragma once

#include "VendorLibrary.h"

namespace petrous::devices
{

/// The functions of Force Dimension's C API (libdhd, also contained in libdrd) that the server
/// calls, by the signatures of its reference manual. Metres, newtons, newton metres. A result below
/// 0 is an error; DHD_TIMEGUARD (1) and DHD_MOTOR_SATURATED (2) are not.
struct DhdApi
{
  // Indices of dhdGetStatus. Later versions of the SDK have more entries.
  enum Status
  {
    kPower = 0,
    kConnected = 1,
    kReset = 3, ///< calibrated
    kForce = 5, ///< forces are enabled
    kError = 9,
    kForceOffCause = 14,
    kStatusRoom = 64
  };

  // Values of kForceOffCause.
  enum Cause
  {
    kButton = 1,
    kVelocity = 2,
    kWatchdog = 3,
    kDeadman = 6
  };

  int (*open)() = nullptr;
  int (*close)(char id) = nullptr;
  const char* (*errorGetLastStr)() = nullptr;
  const char* (*getSystemName)(char id) = nullptr;
  bool (*hasWrist)(char id) = nullptr;
  bool (*hasActiveWrist)(char id) = nullptr;
  bool (*hasGripper)(char id) = nullptr;
  int (*getStatus)(int* status, char id) = nullptr;
  int (*enableForce)(unsigned char on, char id) = nullptr;
  int (*setBrakes)(int on, char id) = nullptr;
  int (*setGravityCompensation)(int on, char id) = nullptr;
  int (*setEffectorMass)(double kilograms, char id) = nullptr;
  int (*emulateButton)(unsigned char on, char id) = nullptr;
  unsigned int (*getButtonMask)(char id) = nullptr;
  int (*getPose)(double* x, double* y, double* z, double matrix[3][3], char id) = nullptr;
  int (*setForceAndTorque)(double fx, double fy, double fz, double tx, double ty, double tz,
                           char id) = nullptr;
  int (*getSerialNumber)(unsigned short* number, char id) = nullptr; ///< not in every version
  // Of the expert API; not in every version.
  int (*enableExpertMode)() = nullptr;
  int (*disableExpertMode)() = nullptr;
  int (*setWatchdog)(unsigned char eighths, char id) = nullptr; ///< of a millisecond

  void load(VendorLibrary& library)
  {
    library.load("dhdOpen", open);
    library.load("dhdClose", close);
    library.load("dhdErrorGetLastStr", errorGetLastStr);
    library.load("dhdGetSystemName", getSystemName);
    library.load("dhdHasWrist", hasWrist);
    library.load("dhdHasActiveWrist", hasActiveWrist);
    library.load("dhdHasGripper", hasGripper);
    library.load("dhdGetStatus", getStatus);
    library.load("dhdEnableForce", enableForce);
    library.load("dhdSetBrakes", setBrakes);
    library.load("dhdSetGravityCompensation", setGravityCompensation);
    library.load("dhdSetEffectorMass", setEffectorMass);
    library.load("dhdEmulateButton", emulateButton);
    library.load("dhdGetButtonMask", getButtonMask);
    library.load("dhdGetPositionAndOrientationFrame", getPose);
    library.load("dhdSetForceAndTorque", setForceAndTorque);
    library.load("dhdGetSerialNumber", getSerialNumber, false);
    library.load("dhdEnableExpertMode", enableExpertMode, false);
    library.load("dhdDisableExpertMode", disableExpertMode, false);
    library.load("dhdSetWatchdog", setWatchdog, false);
  }
};

} // namespace petrous::devices
