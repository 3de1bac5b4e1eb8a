/* Minimal complete device server, also used by the tests.
 *
 *   petrous-device-example [--radius MM] [--period S] [--compliance MM/N] [--record FILE] BLOCK
 *
 * Instead of a vendor's SDK it has a simulated handle that moves in a circle, displaced by
 * compliance * force. --record writes each wrench applied by the motors to FILE, one per line: time
 * in s, tick, force in N, torque in N mm. A server for a real device keeps `main` and replaces the
 * three functions whose names begin with `device_`.
 */
#define _GNU_SOURCE

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "petrous/Devices/DeviceServerExchange.h"

static const int64_t tick_ns = 1000000;
static const int64_t alone_ns = INT64_C(5000000000); /* Petrous is gone without notice */

static volatile sig_atomic_t asked_to_end = 0;

static void on_signal(int number)
{
  (void)number;
  asked_to_end = 1;
}

static int64_t now_ns(void)
{
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

/* ---- the device ---------------------------------------------------------------------------- */

struct device
{
  double radius;     /* mm */
  double period;     /* s */
  double compliance; /* mm/N */
  double force[3];   /* applied by the motors, N */
  int64_t start_ns;
  FILE* record;
};

static void device_describe(struct petrous_device_block* block)
{
  const double force = 3.3, torque = 0.0, stiffness = 0.4, angular = 0.0;
  petrous_device_text(block->name, sizeof block->name, "Petrous example device");
  __atomic_store(&block->max_force, &force, __ATOMIC_RELAXED);
  __atomic_store(&block->max_torque, &torque, __ATOMIC_RELAXED);
  __atomic_store(&block->max_stiffness, &stiffness, __ATOMIC_RELAXED);
  __atomic_store(&block->max_angular_stiffness, &angular, __ATOMIC_RELAXED);
  __atomic_store_n(&block->flags, PETROUS_SENSES_ROTATION | PETROUS_GIVES_FORCE, __ATOMIC_RELAXED);
}

static struct petrous_device_pose device_read(const struct device* device, int64_t now)
{
  struct petrous_device_pose pose;
  const double angle = 6.283185307179586 * (double)(now - device->start_ns) * 1e-9 / device->period;
  int i;
  memset(&pose, 0, sizeof pose);
  pose.time_ns = (uint64_t)now;
  pose.position[0] = device->radius * cos(angle);
  pose.position[1] = device->radius * sin(angle);
  for (i = 0; i < 3; ++i)
    pose.position[i] += device->compliance * device->force[i];
  pose.rotation[0] = cos(0.5 * angle);
  pose.rotation[3] = sin(0.5 * angle);
  return pose;
}

static void device_drive(struct device* device, const struct petrous_device_wrench* wrench,
                         int64_t now)
{
  memcpy(device->force, wrench->force, sizeof device->force);
  if (device->record)
    fprintf(device->record, "%.6f %llu %g %g %g %g %g %g\n",
            (double)(now - device->start_ns) * 1e-9, (unsigned long long)wrench->tick,
            wrench->force[0], wrench->force[1], wrench->force[2], wrench->torque[0],
            wrench->torque[1], wrench->torque[2]);
}

/* ---- the server ---------------------------------------------------------------------------- */

static struct petrous_device_block* open_block(const char* name)
{
  struct petrous_device_block* block;
  struct stat status;
  const int file = shm_open(name, O_RDWR, 0);
  if (file < 0 || fstat(file, &status) != 0)
  {
    fprintf(stderr, "petrous-device-example: %s: %s\n", name, strerror(errno));
    return NULL;
  }
  if (status.st_size < (off_t)sizeof *block)
  {
    fprintf(stderr, "petrous-device-example: %s: too small for a device block\n", name);
    return NULL;
  }
  block = mmap(NULL, sizeof *block, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (block == MAP_FAILED)
  {
    fprintf(stderr, "petrous-device-example: %s: %s\n", name, strerror(errno));
    return NULL;
  }
  /* Set for any version of Petrous, so that it can report the mismatch. */
  __atomic_store_n(&block->server_version, PETROUS_DEVICE_VERSION, __ATOMIC_RELEASE);
  if (__atomic_load_n(&block->magic, __ATOMIC_ACQUIRE) != PETROUS_DEVICE_MAGIC ||
      __atomic_load_n(&block->version, __ATOMIC_ACQUIRE) != PETROUS_DEVICE_VERSION)
  {
    fprintf(stderr, "petrous-device-example: %s: version %u of the protocol, this server has %u\n",
            name, __atomic_load_n(&block->version, __ATOMIC_ACQUIRE), PETROUS_DEVICE_VERSION);
    return NULL;
  }
  return block;
}

static void serve(struct petrous_device_block* block, struct device* device)
{
  struct petrous_device_guard guard;
  struct timespec wake;
  uint64_t petrous_beat = 0;
  int64_t heard_ns = now_ns();
  memset(&guard, 0, sizeof guard);
  clock_gettime(CLOCK_MONOTONIC, &wake);
  while (!asked_to_end)
  {
    const int64_t now = now_ns();
    const uint64_t beat = __atomic_load_n(&block->petrous_beat, __ATOMIC_ACQUIRE);
    const struct petrous_device_wrench wrench = petrous_device_wrench_now(block, &guard, now);
    struct petrous_device_pose pose;
    device_drive(device, &wrench, now);
    pose = device_read(device, now);
    pose.echo = wrench.tick;
    petrous_device_put(&block->pose_sequence, block->pose, &pose);
    __atomic_add_fetch(&block->server_beat, 1, __ATOMIC_RELEASE);

    if (beat != petrous_beat)
      heard_ns = now;
    petrous_beat = beat;
    if (__atomic_load_n(&block->petrous_state, __ATOMIC_ACQUIRE) != PETROUS_RUNNING ||
        now - heard_ns > alone_ns)
      break;

    wake.tv_nsec += tick_ns;
    if (wake.tv_nsec >= 1000000000)
    {
      wake.tv_nsec -= 1000000000;
      ++wake.tv_sec;
    }
    /* After a long pause do not make up for missed ticks. */
    if (now - ((int64_t)wake.tv_sec * 1000000000 + wake.tv_nsec) > 100 * tick_ns)
      clock_gettime(CLOCK_MONOTONIC, &wake);
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, NULL);
  }
}

int main(int argc, char** argv)
{
  struct device device = {20.0, 4.0, 0.0, {0.0, 0.0, 0.0}, 0, NULL};
  struct petrous_device_block* block;
  struct petrous_device_wrench zero;
  struct sigaction action;
  int i;
  for (i = 1; i + 2 < argc; i += 2)
  {
    if (strcmp(argv[i], "--radius") == 0)
      device.radius = atof(argv[i + 1]);
    else if (strcmp(argv[i], "--period") == 0)
      device.period = atof(argv[i + 1]);
    else if (strcmp(argv[i], "--compliance") == 0)
      device.compliance = atof(argv[i + 1]);
    else if (strcmp(argv[i], "--record") == 0)
      device.record = fopen(argv[i + 1], "w");
    else
      break;
  }
  if (i + 1 != argc || !(device.period > 0.0))
  {
    fprintf(stderr, "usage: petrous-device-example [--radius MM] [--period S] [--compliance MM/N] "
                    "[--record FILE] BLOCK\n");
    return 2;
  }
  memset(&action, 0, sizeof action);
  action.sa_handler = on_signal;
  sigaction(SIGTERM, &action, NULL);
  sigaction(SIGINT, &action, NULL);

  block = open_block(argv[i]);
  if (!block)
    return 1;
  __atomic_store_n(&block->server_pid, (uint32_t)getpid(), __ATOMIC_RELAXED);
  __atomic_store_n(&block->server_state, PETROUS_SERVER_STARTING, __ATOMIC_RELEASE);
  device.start_ns = now_ns();
  device_describe(block);
  __atomic_store_n(&block->server_state, PETROUS_SERVER_READY, __ATOMIC_RELEASE);
  serve(block, &device);

  memset(&zero, 0, sizeof zero);
  device_drive(&device, &zero, now_ns());
  if (device.record)
    fclose(device.record);
  return 0;
}
