#pragma once

/* A shared library with hidapi's C interface (the 22 functions of 0.13) and no hardware: connected
 * devices and their reports come from a script. For tests of HID device code; loaded by
 * HidLibrary(path), or preloaded into a whole program, with the script's file in the environment
 * variable PETROUS_STANDIN_HID.
 *
 * A script has one command per line; '#' begins a comment. NODE is the path reported by hidapi.
 *
 *   plug NODE VENDOR PRODUCT PAGE USAGE NAME...  connect a device; the four numbers are hexadecimal
 *   deny NODE                                    opening it fails from now on
 *   allow NODE                                   opening it succeeds again
 *   await NODE                                   wait until it has been opened
 *   report NODE BYTE...                          send a report of these hexadecimal bytes; fewer
 *                                                than the device's own are a short read
 *   error NODE                                   the next read fails, once
 *   unplug NODE                                  every read fails, and it is not enumerated
 *   wait MS                                      pause
 *   jitter MS                                    lengthen or shorten every wait by up to MS,
 *                                                deterministically
 *   repeat COUNT ... end                         not nested
 *
 * As with hidraw, 64 reports are queued for a reader and further ones are lost, and a report of a
 * device that nobody has opened is lost. */

#ifdef __cplusplus
extern "C"
{
#endif

  /* Plays a script on a thread of the library, after any that still plays. Returns 0, or the number
   * of the first invalid line; then nothing is played. */
  int standin_play(const char* script);

  /* Waits until everything has been played. */
  void standin_finish(void);

  /* Stops playing and removes all devices. None may be open. */
  void standin_reset(void);

  /* How many times NODE has been opened, including closed handles. */
  int standin_opened(const char* node);

#ifdef __cplusplus
}
#endif
