#define _GNU_SOURCE

#include "DeviceServer.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

static const int64_t tick_ns = 1000000;
static const int64_t look_ns = 10000000;                /* of the supervising thread */
static const int64_t alone_ns = INT64_C(5000000000);    /* Petrous is gone without notice */
static const int64_t late_ns = 300000000;               /* the SDK hangs */
static const int64_t end_ns = 400000000;                /* then the process ends without the SDK */
static const int64_t ask_ns = 100000000;                /* between two looks at the calibration */
static const int64_t opening_ns = INT64_C(30000000000); /* an SDK may take to open a device */
static const int64_t retry_ns = 500000000;              /* between two attempts to open */

struct petrous_device_server
{
  const struct petrous_device_driver* driver;
  struct petrous_device_block* block;
  struct petrous_device_guard guard;
  double max_force;
  double max_torque;
  int blind; /* the last pose was not finite */

  /* Between the threads. */
  int open;             /* step may be called */
  int ending;           /* the device is to be closed */
  int told;             /* `text` is published */
  int64_t exchanged_ns; /* end of the last exchange, or when opening began */
  pid_t parent;         /* which started the server */
  uint32_t result;      /* of the last step */
  char text[128];       /* of petrous_device_explain; read by the thread that writes it */
};

static volatile sig_atomic_t asked_to_end = 0;

static void on_signal(int number)
{
  (void)number;
  asked_to_end = 1;
}

int64_t petrous_device_now(void)
{
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static void sleep_until(int64_t time)
{
  struct timespec wake;
  wake.tv_sec = (time_t)(time / 1000000000);
  wake.tv_nsec = (long)(time % 1000000000);
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &wake, NULL);
}

void petrous_device_quaternion(double m[3][3], double quaternion[4])
{
  /* 4 q q^T, of which the row with the largest diagonal is normalised (Shepperd 1978). */
  const double products[4][4] = {
      {1.0 + m[0][0] + m[1][1] + m[2][2], m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]},
      {m[2][1] - m[1][2], 1.0 + m[0][0] - m[1][1] - m[2][2], m[0][1] + m[1][0], m[0][2] + m[2][0]},
      {m[0][2] - m[2][0], m[0][1] + m[1][0], 1.0 - m[0][0] + m[1][1] - m[2][2], m[1][2] + m[2][1]},
      {m[1][0] - m[0][1], m[0][2] + m[2][0], m[1][2] + m[2][1], 1.0 - m[0][0] - m[1][1] + m[2][2]}};
  double norm = 0.0;
  int most = 0;
  int i;
  for (i = 1; i < 4; ++i)
    if (products[i][i] > products[most][most])
      most = i;
  for (i = 0; i < 4; ++i)
    norm += products[most][i] * products[most][i];
  norm = sqrt(norm);
  for (i = 0; i < 4; ++i)
    quaternion[i] = products[most][i] / norm;
}

/* ---- block --------------------------------------------------------------------------------- */

static struct petrous_device_block* open_block(const char* program, const char* name)
{
  struct petrous_device_block* block;
  struct stat status;
  const int file = shm_open(name, O_RDWR, 0);
  if (file < 0 || fstat(file, &status) != 0)
  {
    fprintf(stderr, "%s: %s: %s\n", program, name, strerror(errno));
    return NULL;
  }
  if (status.st_size < (off_t)sizeof *block)
  {
    fprintf(stderr, "%s: %s: too small for a device block\n", program, name);
    return NULL;
  }
  block = mmap(NULL, sizeof *block, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  if (block == MAP_FAILED)
  {
    fprintf(stderr, "%s: %s: %s\n", program, name, strerror(errno));
    return NULL;
  }
  /* Set for any version of Petrous, so that it can report the mismatch. */
  __atomic_store_n(&block->server_version, PETROUS_DEVICE_VERSION, __ATOMIC_RELEASE);
  if (__atomic_load_n(&block->magic, __ATOMIC_ACQUIRE) != PETROUS_DEVICE_MAGIC ||
      __atomic_load_n(&block->version, __ATOMIC_ACQUIRE) != PETROUS_DEVICE_VERSION)
  {
    fprintf(stderr, "%s: %s: version %u of the protocol, this server has %u\n", program, name,
            __atomic_load_n(&block->version, __ATOMIC_ACQUIRE), PETROUS_DEVICE_VERSION);
    return NULL;
  }
  return block;
}

static void publish(struct petrous_device_server* server, uint32_t state)
{
  const char* text = state == PETROUS_SERVER_READY ? "" : server->text;
  server->told = 1;
  petrous_device_text(server->block->error, sizeof server->block->error, text);
  __atomic_store_n(&server->block->server_state, state, __ATOMIC_RELEASE);
}

void petrous_device_describe(struct petrous_device_server* server,
                             const struct petrous_device_description* description)
{
  struct petrous_device_block* block = server->block;
  petrous_device_text(block->name, sizeof block->name, description->name);
  __atomic_store_n(&block->flags, description->flags, __ATOMIC_RELAXED);
  __atomic_store(&block->max_force, &description->max_force, __ATOMIC_RELAXED);
  __atomic_store(&block->max_torque, &description->max_torque, __ATOMIC_RELAXED);
  __atomic_store(&block->max_stiffness, &description->max_stiffness, __ATOMIC_RELAXED);
  __atomic_store(&block->max_angular_stiffness, &description->max_angular_stiffness,
                 __ATOMIC_RELAXED);
  server->max_force = description->flags & PETROUS_GIVES_FORCE ? description->max_force : 0.0;
  server->max_torque = description->flags & PETROUS_GIVES_TORQUE ? description->max_torque : 0.0;
}

void petrous_device_explain(struct petrous_device_server* server, const char* text)
{
  if (strncmp(server->text, text, sizeof server->text - 1) == 0)
    return;
  snprintf(server->text, sizeof server->text, "%s", text);
  server->told = 0;
}

/* ---- tick ---------------------------------------------------------------------------------- */

static void limit(double vector[3], double most)
{
  const double norm = sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
  int i;
  if (norm > most)
    for (i = 0; i < 3; ++i)
      vector[i] *= most / norm;
}

static int finite_pose(const struct petrous_device_pose* pose)
{
  int good = 1;
  int i;
  for (i = 0; i < 3; ++i)
    good = good && isfinite(pose->position[i]);
  for (i = 0; i < 4; ++i)
    good = good && isfinite(pose->rotation[i]);
  return good;
}

uint32_t petrous_device_exchange(struct petrous_device_server* server)
{
  struct petrous_device_block* block = server->block;
  struct petrous_device_pose pose;
  struct petrous_device_wrench wrench;
  uint32_t result;
  const int ending = __atomic_load_n(&server->ending, __ATOMIC_ACQUIRE);
  wrench = petrous_device_wrench_now(block, &server->guard, petrous_device_now());
  if (ending || server->result != PETROUS_SERVER_READY || server->blind)
    memset(&wrench, 0, sizeof wrench);
  limit(wrench.force, server->max_force);
  limit(wrench.torque, server->max_torque);

  memset(&pose, 0, sizeof pose);
  pose.rotation[0] = 1.0;
  result = server->driver->step(server->driver->device, server, &wrench, &pose);
  server->blind = !finite_pose(&pose);
  pose.echo = wrench.tick;
  if (result == PETROUS_SERVER_READY && pose.time_ns != 0)
    petrous_device_put(&block->pose_sequence, block->pose, &pose);
  /* The supervising thread may have published another state. */
  if (result != __atomic_load_n(&block->server_state, __ATOMIC_ACQUIRE) ||
      (result != PETROUS_SERVER_READY && !server->told))
    publish(server, result);
  __atomic_store_n(&server->result, result, __ATOMIC_RELEASE);
  __atomic_store_n(&server->exchanged_ns, petrous_device_now(), __ATOMIC_RELEASE);
  __atomic_add_fetch(&block->server_beat, 1, __ATOMIC_RELEASE);
  return ending ? PETROUS_SERVER_NO_DEVICE : result;
}

/* ---- supervision --------------------------------------------------------------------------- */

/* Looks after Petrous and after the SDK from a thread of its own, as the SDK may hang. */
static void* supervise(void* argument)
{
  struct petrous_device_server* server = argument;
  struct petrous_device_block* block = server->block;
  /* Where Petrous itself started the server, its death is seen at once. */
  const int child =
      (uint32_t)server->parent == __atomic_load_n(&block->petrous_pid, __ATOMIC_RELAXED);
  uint64_t beat = 0;
  int64_t heard_ns = petrous_device_now();
  int64_t ended_ns = 0;
  for (;;)
  {
    const int64_t now = petrous_device_now();
    const uint64_t petrous = __atomic_load_n(&block->petrous_beat, __ATOMIC_ACQUIRE);
    if (petrous != beat)
      heard_ns = now;
    beat = petrous;
    if (asked_to_end || now - heard_ns > alone_ns || (child && getppid() != server->parent) ||
        __atomic_load_n(&block->petrous_state, __ATOMIC_ACQUIRE) != PETROUS_RUNNING)
      __atomic_store_n(&server->ending, 1, __ATOMIC_RELEASE);
    if (__atomic_load_n(&server->ending, __ATOMIC_ACQUIRE))
    {
      ended_ns = ended_ns ? ended_ns : now;
      if (now - ended_ns > end_ns)
      {
        fprintf(stderr, "%s: the device's driver does not return; ends without it\n",
                server->driver->program);
        _exit(4);
      }
    }
    else if (!__atomic_load_n(&server->open, __ATOMIC_ACQUIRE))
    {
      if (now - __atomic_load_n(&server->exchanged_ns, __ATOMIC_ACQUIRE) < opening_ns)
        __atomic_add_fetch(&block->server_beat, 1, __ATOMIC_RELEASE);
    }
    else if (now - __atomic_load_n(&server->exchanged_ns, __ATOMIC_ACQUIRE) > late_ns &&
             __atomic_load_n(&block->server_state, __ATOMIC_ACQUIRE) != PETROUS_SERVER_FAULT)
    {
      petrous_device_text(block->error, sizeof block->error,
                          "the device's driver has not answered for 0.3 s");
      __atomic_store_n(&block->server_state, PETROUS_SERVER_FAULT, __ATOMIC_RELEASE);
    }
    sleep_until(now + look_ns);
  }
  return NULL;
}

/* No force while the device waits for its calibration: `open` need not send any. */
static void release(struct petrous_device_server* server)
{
  struct petrous_device_wrench zero;
  struct petrous_device_pose pose;
  memset(&zero, 0, sizeof zero);
  memset(&pose, 0, sizeof pose);
  server->driver->step(server->driver->device, server, &zero, &pose);
}

/* Steps until the device is lost or is to be closed; the state that ended it. */
static uint32_t run(struct petrous_device_server* server)
{
  int64_t wake = petrous_device_now();
  uint32_t result = PETROUS_SERVER_READY;
  while (!__atomic_load_n(&server->ending, __ATOMIC_ACQUIRE))
  {
    int64_t now;
    if (server->driver->own_thread)
      result = __atomic_load_n(&server->result, __ATOMIC_ACQUIRE);
    else
      result = petrous_device_exchange(server);
    if (result == PETROUS_SERVER_NO_DEVICE || result == PETROUS_SERVER_STARTING)
      break;
    now = petrous_device_now();
    /* After a long pause do not make up for missed ticks. */
    wake = now - wake > 100 * tick_ns ? now : wake + tick_ns;
    sleep_until(wake);
  }
  return result;
}

static void serve(struct petrous_device_server* server)
{
  const struct petrous_device_driver* driver = server->driver;
  while (!__atomic_load_n(&server->ending, __ATOMIC_ACQUIRE))
  {
    uint32_t state;
    int64_t wait;
    memset(&server->guard, 0, sizeof server->guard);
    server->blind = 0;
    /* Until a step says otherwise; set before `open` may start the SDK's thread. */
    __atomic_store_n(&server->result, PETROUS_SERVER_READY, __ATOMIC_RELEASE);
    __atomic_store_n(&server->exchanged_ns, petrous_device_now(), __ATOMIC_RELEASE);
    state = driver->open(driver->device, server);
    if (state == PETROUS_SERVER_READY)
    {
      __atomic_store_n(&server->exchanged_ns, petrous_device_now(), __ATOMIC_RELEASE);
      publish(server, state);
      __atomic_store_n(&server->open, 1, __ATOMIC_RELEASE);
      state = run(server);
      if (state == PETROUS_SERVER_STARTING && !driver->own_thread)
        release(server);
      __atomic_store_n(&server->open, 0, __ATOMIC_RELEASE);
    }
    if (__atomic_load_n(&server->ending, __ATOMIC_ACQUIRE))
      break;
    publish(server, state);
    if (state != PETROUS_SERVER_STARTING)
      driver->close(driver->device);
    for (wait = 0; wait < (state == PETROUS_SERVER_STARTING ? ask_ns : retry_ns) &&
                   !__atomic_load_n(&server->ending, __ATOMIC_ACQUIRE);
         wait += look_ns)
      sleep_until(petrous_device_now() + look_ns);
  }
  driver->close(driver->device);
}

int petrous_device_serve(const struct petrous_device_driver* driver, const char* block_name)
{
  static struct petrous_device_server server; /* outlives the supervising thread */
  struct sigaction action;
  pthread_t thread;
  memset(&action, 0, sizeof action);
  action.sa_handler = on_signal;
  sigaction(SIGTERM, &action, NULL);
  sigaction(SIGINT, &action, NULL);

  server.parent = getppid(); /* the thread that watches it may begin when it is gone */
  server.driver = driver;
  server.block = open_block(driver->program, block_name);
  if (!server.block)
    return 1;
  __atomic_store_n(&server.block->server_pid, (uint32_t)getpid(), __ATOMIC_RELAXED);
  __atomic_store_n(&server.block->server_state, PETROUS_SERVER_STARTING, __ATOMIC_RELEASE);
  if (pthread_create(&thread, NULL, supervise, &server) != 0)
  {
    fprintf(stderr, "%s: cannot start a thread\n", driver->program);
    return 1;
  }
  pthread_detach(thread);
  serve(&server);
  return 0;
}
