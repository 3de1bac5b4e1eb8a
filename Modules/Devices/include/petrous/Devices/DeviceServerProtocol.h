#pragma once

/* Shared memory block of a device server and Petrous, version 1. Plain C, GCC or clang.
 *
 * A server is a small program that uses a vendor's SDK. Petrous creates the block with
 * shm_open("/petrous-device-NAME") and starts the server with that name as its last argument; the
 * server opens and maps it. Documentation/device-servers.md has the life cycle and safety rules.
 *
 * Units mm, N, N mm, rad. Frame D of the device: right-handed, +x right, +y up, +z to the user.
 * Native byte order. Access fields only with the functions of DeviceServerExchange.h or with
 * __atomic builtins, never by plain assignment. Offsets and meanings of a version never change;
 * `magic`, `version`, `size` and `server_version` are at the same offsets in all versions.
 */

#include <stddef.h>
#include <stdint.h>

#define PETROUS_DEVICE_MAGIC UINT64_C(0x3156454452544550) /* the bytes "PETRDEV1" */
#define PETROUS_DEVICE_VERSION 1u
#define PETROUS_DEVICE_SILENCE_NS                                                                  \
  INT64_C(50000000) /* motors off without a wrench for this long                                   \
                     */

/* petrous_state */
enum
{
  PETROUS_RUNNING = 1,
  PETROUS_CLOSING = 2 /* the server turns its motors off and exits */
};

/* server_state */
enum
{
  PETROUS_SERVER_EMPTY = 0,     /* no server has opened the block */
  PETROUS_SERVER_STARTING = 1,  /* opening or calibrating the device */
  PETROUS_SERVER_READY = 2,     /* description is valid, poses are sent */
  PETROUS_SERVER_NO_DEVICE = 3, /* device unplugged or switched off; `error` may say more */
  PETROUS_SERVER_FAULT = 4      /* the SDK reports an error; `error` says which */
};

/* flags */
enum
{
  PETROUS_SENSES_ROTATION = 1,
  PETROUS_GIVES_FORCE = 2,
  PETROUS_GIVES_TORQUE = 4
};

/* Server to Petrous, at the device's rate, ideally 1 kHz. */
struct petrous_device_pose
{
  uint64_t time_ns;   /* CLOCK_MONOTONIC of the measurement */
  uint64_t echo;      /* tick of the wrench now applied by the motors; 0 if they are off */
  double position[3]; /* of the grip, mm */
  double rotation[4]; /* unit quaternion w, x, y, z: handle to D; handle's +z to the wrist */
  uint64_t buttons;   /* bit n: button n is held; bits 0 to 31 */
  double pedal;       /* 0 to 1 */
  uint64_t reserved[4];
};

/* Petrous to server, once per servo tick. */
struct petrous_device_wrench
{
  uint64_t tick;    /* counts up from 1 */
  double force[3];  /* on the hand, N */
  double torque[3]; /* on the hand about the grip, N mm */
  uint64_t reserved[8];
};

#define PETROUS_DEVICE_WORDS 15u /* 64-bit words of either struct */

struct petrous_device_block
{
  /* offset 0: written by Petrous */
  uint64_t magic; /* written last when the block is created */
  uint32_t version;
  uint32_t size; /* bytes of the block */
  uint32_t petrous_pid;
  uint32_t petrous_state;
  uint64_t petrous_beat; /* incremented at least 20 times a second while Petrous runs */
  uint64_t reserved0[4];

  /* offset 64: written by the server; server_state last */
  uint32_t server_version; /* PETROUS_DEVICE_VERSION of the header it was built with */
  uint32_t server_pid;
  uint32_t server_state;
  uint32_t flags;
  uint64_t server_beat;         /* incremented at least 100 times a second, by the SDK's thread */
  double max_force;             /* N */
  double max_torque;            /* N mm */
  double max_stiffness;         /* N/mm rendered stably */
  double max_angular_stiffness; /* N mm/rad */
  uint64_t reserved1;
  char name[64];   /* for display, UTF-8, zero-terminated */
  char error[128]; /* likewise; empty without an error */

  /* offset 320: server to Petrous; the sequence is odd while the words are being written */
  uint64_t pose_sequence;
  uint64_t pose[PETROUS_DEVICE_WORDS];

  /* offset 448: Petrous to server */
  uint64_t wrench_sequence;
  uint64_t wrench[PETROUS_DEVICE_WORDS];
};

#ifdef __cplusplus
static_assert(sizeof(petrous_device_pose) == 8 * PETROUS_DEVICE_WORDS, "layout");
static_assert(sizeof(petrous_device_wrench) == 8 * PETROUS_DEVICE_WORDS, "layout");
static_assert(offsetof(petrous_device_block, server_version) == 64, "layout");
static_assert(offsetof(petrous_device_block, pose_sequence) == 320, "layout");
static_assert(offsetof(petrous_device_block, wrench_sequence) == 448, "layout");
static_assert(sizeof(petrous_device_block) == 576, "layout");
#endif
