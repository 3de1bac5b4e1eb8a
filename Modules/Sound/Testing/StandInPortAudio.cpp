// PortAudio's C interface without a sound card: blocks are asked for by the test.

#include <cstdlib>
#include <cstring>
#include <string>

namespace
{

using Callback = int (*)(const void*, void*, unsigned long, const void*, unsigned long, void*);

struct Device
{
  int version = 2;
  const char* name = "stand-in";
  int hostApi = 0;
  int inputs = 0, outputs = 2;
  double lowInputLatency = 0.01, lowOutputLatency = 0.008;
  double highInputLatency = 0.1, highOutputLatency = 0.1;
  double rate = 44100.0;
} device;

Callback callback = nullptr;
void* user = nullptr;
unsigned long block = 0;
double rateOpened = 0.0;
bool running = false;
int initialized = 0;

bool fails(const char* what)
{
  const char* fault = std::getenv("PETROUS_STANDIN_SOUND_FAULT");
  return fault && std::strcmp(fault, what) == 0;
}

} // namespace

extern "C"
{

  int Pa_Initialize()
  {
    if (fails("initialize"))
      return -9999;
    ++initialized;
    return 0;
  }

  int Pa_Terminate()
  {
    --initialized;
    return 0;
  }

  int Pa_GetDefaultOutputDevice()
  {
    return fails("nothing") ? -1 : 0;
  }

  const void* Pa_GetDeviceInfo(int)
  {
    return &device;
  }

  int Pa_IsFormatSupported(const void*, const void*, double rate)
  {
    return fails("rate") && rate != device.rate ? -9997 : 0;
  }

  int Pa_OpenStream(void** stream, const void*, const void*, double rate, unsigned long frames,
                    unsigned long, Callback called, void* data)
  {
    if (fails("open"))
      return -9985;
    rateOpened = rate;
    block = frames;
    callback = called;
    user = data;
    *stream = &device;
    return 0;
  }

  int Pa_StartStream(void*)
  {
    if (fails("start"))
      return -9999;
    running = true;
    return 0;
  }

  int Pa_IsStreamActive(void*)
  {
    return running && !fails("gone") ? 1 : 0;
  }

  int Pa_AbortStream(void*)
  {
    running = false;
    return 0;
  }

  int Pa_CloseStream(void*)
  {
    callback = nullptr;
    return 0;
  }

  // The next block, of the size that was agreed; 0: nothing plays.
  unsigned long standin_play(float* samples)
  {
    if (!running || !callback)
      return 0;
    callback(nullptr, samples, block, nullptr, 0, user);
    return block;
  }

  double standin_rate()
  {
    return rateOpened;
  }

  int standin_initialized()
  {
    return initialized;
  }
}
