/* Minimal complete device server, also used by the tests.
 *
 *   petrous-device-example [--radius MM] [--period S] [--compliance MM/N] [--record FILE] BLOCK
 *
 * Instead of a vendor's SDK it has a simulated handle that moves in a circle, displaced by
 * compliance * force. --record writes each wrench applied by the motors to FILE, one per line: time
 * in s, tick, force in N, torque in N mm. A server for a real device replaces the functions whose
 * names begin with `device_`; the rest of a server is in DeviceServer.c.
 */
#include <stdio.h>
#include <stdlib.h>

#include "DeviceServer.h"

struct device
{
  double radius;     /* mm */
  double period;     /* s */
  double compliance; /* mm/N */
  double force[3];   /* applied by the motors, N */
  int64_t start_ns;
  FILE* record;
};

static uint32_t device_open(void* data, struct petrous_device_server* server)
{
  const struct petrous_device_description description = {
      "Petrous example device", PETROUS_SENSES_ROTATION | PETROUS_GIVES_FORCE, 3.3, 0.0, 0.4, 0.0};
  struct device* device = data;
  device->start_ns = petrous_device_now();
  petrous_device_describe(server, &description);
  return PETROUS_SERVER_READY;
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

static uint32_t device_step(void* data, struct petrous_device_server* server,
                            const struct petrous_device_wrench* wrench,
                            struct petrous_device_pose* pose)
{
  struct device* device = data;
  const int64_t now = petrous_device_now();
  const double angle = 6.283185307179586 * (double)(now - device->start_ns) * 1e-9 / device->period;
  int i;
  (void)server;
  device_drive(device, wrench, now);
  pose->time_ns = (uint64_t)now;
  pose->position[0] = device->radius * cos(angle);
  pose->position[1] = device->radius * sin(angle);
  for (i = 0; i < 3; ++i)
    pose->position[i] += device->compliance * device->force[i];
  pose->rotation[0] = cos(0.5 * angle);
  pose->rotation[3] = sin(0.5 * angle);
  return PETROUS_SERVER_READY;
}

static void device_close(void* data)
{
  struct petrous_device_wrench zero;
  struct device* device = data;
  memset(&zero, 0, sizeof zero);
  device_drive(device, &zero, petrous_device_now());
  if (device->record)
    fclose(device->record);
  device->record = NULL;
}

int main(int argc, char** argv)
{
  struct device device = {20.0, 4.0, 0.0, {0.0, 0.0, 0.0}, 0, NULL};
  const struct petrous_device_driver driver = {
      "petrous-device-example", &device, device_open, device_step, device_close, 0};
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
  return petrous_device_serve(&driver, argv[i]);
}
