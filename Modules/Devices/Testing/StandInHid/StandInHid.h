#pragma once

/* A shared library with hidapi's C interface (the 22 functions of 0.13) and no hardware: what is
 * plugged in and what it reports comes from a script. For tests of what reads HID devices; to be
 * loaded by HidLibrary(path), or preloaded under a whole program, which then gives the script's
 * file in the environment variable PETROUS_STANDIN_HID.
 *
 * A script has one command a line; '#' begins a comment. NODE is the path that hidapi gives.
 *
 *   plug NODE VENDOR PRODUCT PAGE USAGE NAME...  plug a device in; the four numbers are hexadecimal
 *   deny NODE                                    let opening it fail from now on
 *   allow NODE                                   let it succeed again
 *   await NODE                                   wait until somebody has opened it
 *   report NODE BYTE...                          give a report of these hexadecimal bytes; fewer
 *                                                than the device's own are a short read
 *   error NODE                                   let the next read fail, once
 *   unplug NODE                                  every read fails, and the list lacks it
 *   wait MS                                      do nothing for so long
 *   jitter MS                                    lengthen or shorten every wait by up to MS,
 *                                                the same way in each run
 *   repeat COUNT ... end                         not nested
 *
 * As with hidraw, 64 reports wait for a reader and further ones are lost, and a report that nobody
 * has opened the device for is lost. */

#ifdef __cplusplus
extern "C"
{
#endif

  /* Plays a script on a thread of the library, behind what still plays. 0, or the number of the
   * first line that is not understood; then nothing is played. */
  int standin_play(const char* script);

  /* Waits until all has been played. */
  void standin_finish(void);

  /* Stops what plays, unplugs everything and forgets it. Nothing may be open. */
  void standin_reset(void);

  /* How many times NODE has been opened, closed ones counted, too. */
  int standin_opened(const char* node);

#ifdef __cplusplus
}
#endif
