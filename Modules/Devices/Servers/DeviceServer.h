#pragma once

/* The body of a device server, in plain C: block, life cycle and safety rules of
 * Documentation/device-servers.md. A server fills a petrous_device_driver and calls
 * petrous_device_serve from main.
 *
 * The body limits each wrench to the description, gives zero after silence, after a pose that is
 * not finite, in every state but READY and at the end; it tells Petrous when the SDK hangs, and
 * opens a device anew that was unplugged.
 */

#include "petrous/Devices/DeviceServerExchange.h"

#ifdef __cplusplus
extern "C"
{
#endif

  struct petrous_device_server;

  struct petrous_device_description
  {
    const char* name;
    uint32_t flags;               /* PETROUS_SENSES_ROTATION, ... */
    double max_force;             /* N */
    double max_torque;            /* N mm */
    double max_stiffness;         /* N/mm */
    double max_angular_stiffness; /* N mm/rad */
  };

  struct petrous_device_driver
  {
    const char* program; /* for messages on stderr */
    void* device;        /* first argument of the functions below */

    /* Opens the device and calls petrous_device_describe. Returns a state of the server:
     *   READY      step may be called
     *   STARTING   opened, but waits for calibration; petrous_device_explain says what to do
     *   NO_DEVICE, FAULT   not opened; petrous_device_explain says why
     * Unless READY, it is called again every 100 ms (STARTING) or 500 ms, until it is. */
    uint32_t (*open)(void* device, struct petrous_device_server* server);

    /* Once per tick: drives the motors with `wrench`, which is within the limits, and reads the
     * pose with its time. Returns
     *   READY      the pose is valid, or `time_ns` is still 0: no new one
     *   STARTING   calibration was lost: after one more step with zero, open is called again (not
     *              from an own thread)
     *   FAULT      no force is possible (emergency switch, hot motors); step goes on with zero
     *   NO_DEVICE  unplugged: close, then open again */
    uint32_t (*step)(void* device, struct petrous_device_server* server,
                     const struct petrous_device_wrench* wrench, struct petrous_device_pose* pose);

    /* Motors off, device released; after open or step, also if they failed. Idempotent. */
    void (*close)(void* device);

    /* The SDK has a servo thread of its own, which calls petrous_device_exchange between open and
     * close; otherwise the body does, once per millisecond. */
    int own_thread;
  };

  /* Serves until Petrous closes, has died, has been silent for 5 s, or a signal asks to end.
   * Returns the exit status of the server. One server per process. */
  int petrous_device_serve(const struct petrous_device_driver* driver, const char* block_name);

  /* From open. */
  void petrous_device_describe(struct petrous_device_server* server,
                               const struct petrous_device_description* description);

  /* Message to the user, UTF-8, shown with every state but READY; from open or step. */
  void petrous_device_explain(struct petrous_device_server* server, const char* text);

  /* One tick: wrench, step, pose, heartbeat. Returns the state that step returned; NO_DEVICE when
   * the SDK's thread should stop. Neither locks nor allocates. */
  uint32_t petrous_device_exchange(struct petrous_device_server* server);

  /* CLOCK_MONOTONIC, ns. */
  int64_t petrous_device_now(void);

  /* Unit quaternion w, x, y, z of the rotation matrix m[row][column]. */
  void petrous_device_quaternion(double m[3][3], double quaternion[4]);

#ifdef __cplusplus
}
#endif
