// Stand-in of Force Dimension's libdhd: the C interface of its functions that the server calls.

#include "StandInDevice.h"

using petrous::devices::testing::standIn;

namespace
{

bool forcesWork()
{
  return standIn().plugged && standIn().powered && standIn().enabled && standIn().forceOff == 0;
}

} // namespace

extern "C"
{
  int dhdOpen()
  {
    if (!standIn().plugged)
      return -1;
    ++standIn().opened;
    return 0;
  }

  int dhdClose(char)
  {
    ++standIn().closed;
    return 0;
  }

  const char* dhdErrorGetLastStr()
  {
    return "no device found";
  }
  const char* dhdGetSystemName(char)
  {
    return "sigma.7";
  }
  int dhdGetSerialNumber(unsigned short* number, char)
  {
    *number = static_cast<unsigned short>(standIn().serial);
    return standIn().serial ? 0 : -1;
  }
  bool dhdHasWrist(char)
  {
    return true;
  }
  bool dhdHasActiveWrist(char)
  {
    return true;
  }
  bool dhdHasGripper(char)
  {
    return true;
  }

  int dhdGetStatus(int* status, char)
  {
    for (int i = 0; i < 17; ++i) // as many as SDK 3.17 writes
      status[i] = 0;
    status[0] = standIn().powered;
    status[1] = standIn().plugged;
    status[3] = standIn().calibrated;
    status[5] = forcesWork();
    status[9] = standIn().error;
    status[14] = standIn().forceOff;
    return 0;
  }

  int dhdEnableForce(unsigned char on, char)
  {
    standIn().enabled = on;
    // The SDK's own causes end when a program enables forces; a button's do not.
    if (on && (standIn().forceOff == 2 || standIn().forceOff == 3))
      standIn().forceOff = 0;
    return 0;
  }

  int dhdSetBrakes(int, char)
  {
    return 0;
  }

  int dhdSetGravityCompensation(int on, char)
  {
    standIn().gravity = on;
    return 0;
  }

  int dhdSetEffectorMass(double, char)
  {
    return 0;
  }
  int dhdEmulateButton(unsigned char, char)
  {
    return 0;
  }
  unsigned int dhdGetButtonMask(char)
  {
    return standIn().buttons;
  }

  int dhdGetPositionAndOrientationFrame(double* x, double* y, double* z, double matrix[3][3], char)
  {
    standIn().wait();
    if (!standIn().plugged)
      return -1;
    *x = standIn().position[0];
    *y = standIn().position[1];
    *z = standIn().position[2];
    for (int i = 0; i < 9; ++i)
      matrix[i / 3][i % 3] = standIn().rotation[i];
    return 0;
  }

  int dhdSetForceAndTorque(double fx, double fy, double fz, double tx, double ty, double tz, char)
  {
    if (!standIn().plugged)
      return -1;
    const double force[3] = {fx, fy, fz};
    const double torque[3] = {tx, ty, tz};
    for (int i = 0; i < 3; ++i)
    {
      standIn().force[i] = forcesWork() ? force[i] : 0.0;
      standIn().torque[i] = forcesWork() ? torque[i] : 0.0;
    }
    ++standIn().commands;
    return 0;
  }

  int dhdEnableExpertMode()
  {
    return 0;
  }
  int dhdDisableExpertMode()
  {
    return 0;
  }

  int dhdSetWatchdog(unsigned char eighths, char)
  {
    standIn().watchdog = eighths;
    return 0;
  }
}
