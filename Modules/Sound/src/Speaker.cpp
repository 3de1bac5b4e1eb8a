#include "petrous/Sound/Speaker.h"

#include <cstdlib>
#include <mutex>

#include <dlfcn.h>

namespace petrous::sound
{

namespace
{

// Of PortAudio's C interface (portaudio.h, V19), as far as it is used.
struct PaDevice
{
  int version;
  const char* name;
  int hostApi;
  int inputs, outputs;
  double lowInputLatency, lowOutputLatency, highInputLatency, highOutputLatency;
  double rate;
};
struct PaParameters
{
  int device;
  int channels;
  unsigned long format;
  double latency;
  void* special;
};
using PaCallback = int (*)(const void*, void*, unsigned long, const void*, unsigned long, void*);
constexpr unsigned long kFloat32 = 1;
constexpr int kContinue = 0;
constexpr double kWantedRate = 48000.0;

std::mutex calls; // PortAudio's own are not thread-safe, but for the callback

const char* const kUsual = "libportaudio.so.2";

int play(const void*, void* output, unsigned long count, const void*, unsigned long, void* fill)
{
  (*static_cast<Speaker::Fill*>(fill))(static_cast<float*>(output), count);
  return kContinue;
}

} // namespace

struct Speaker::Functions
{
  int (*initialize)() = nullptr;
  int (*terminate)() = nullptr;
  int (*defaultOutput)() = nullptr;
  const PaDevice* (*device)(int) = nullptr;
  int (*isSupported)(const PaParameters*, const PaParameters*, double) = nullptr;
  int (*openStream)(void**, const PaParameters*, const PaParameters*, double, unsigned long,
                    unsigned long, PaCallback, void*) = nullptr;
  int (*startStream)(void*) = nullptr;
  int (*isActive)(void*) = nullptr;
  int (*abortStream)(void*) = nullptr;
  int (*closeStream)(void*) = nullptr;

  Functions(void* library, const std::string& name)
  {
    find(library, name, "Pa_Initialize", initialize);
    find(library, name, "Pa_Terminate", terminate);
    find(library, name, "Pa_GetDefaultOutputDevice", defaultOutput);
    find(library, name, "Pa_GetDeviceInfo", device);
    find(library, name, "Pa_IsFormatSupported", isSupported);
    find(library, name, "Pa_OpenStream", openStream);
    find(library, name, "Pa_StartStream", startStream);
    find(library, name, "Pa_IsStreamActive", isActive);
    find(library, name, "Pa_AbortStream", abortStream);
    find(library, name, "Pa_CloseStream", closeStream);
  }

private:
  template <class Function>
  static void find(void* library, const std::string& name, const char* symbol, Function& function)
  {
    function = reinterpret_cast<Function>(::dlsym(library, symbol));
    if (!function)
      throw SpeakerError(name + " has no function " + symbol + ", which PortAudio 19 has");
  }
};

SpeakerError::SpeakerError(const std::string& message)
  : core::Error(core::Fault::Internal, message)
{
}

Speaker::Speaker(const std::function<Fill(double rate)>& fill)
{
  const std::lock_guard<std::mutex> lock(calls);
  const char* named = std::getenv("PETROUS_PORTAUDIO");
  const std::string name = named && *named ? named : kUsual;
  m_library = ::dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!m_library)
    throw SpeakerError("There is no sound: PortAudio (package libportaudio2) is not installed");
  try
  {
    const Functions functions(m_library, name);
    if (functions.initialize() != 0)
      throw SpeakerError("There is no sound: PortAudio finds no sound system");
    try
    {
      open(functions, fill);
    }
    catch (...)
    {
      functions.terminate();
      throw;
    }
  }
  catch (...)
  {
    ::dlclose(m_library);
    throw;
  }
}

void Speaker::open(const Functions& functions, const std::function<Fill(double rate)>& fill)
{
  const int output = functions.defaultOutput();
  const PaDevice* device = output < 0 ? nullptr : functions.device(output);
  if (!device || device->outputs < 1)
    throw SpeakerError("There is no sound: the computer has no sound output");
  const PaParameters parameters{output, 1, kFloat32, device->lowOutputLatency, nullptr};
  const bool isWanted = functions.isSupported(nullptr, &parameters, kWantedRate) == 0;
  const double rate = isWanted ? kWantedRate : device->rate;
  m_fill = fill(rate);
  if (functions.openStream(&m_stream, nullptr, &parameters, rate, kBlock, 0, play, &m_fill) != 0)
    throw SpeakerError("There is no sound: the sound output cannot be opened; another program may "
                       "have it");
  if (functions.startStream(m_stream) != 0)
  {
    functions.closeStream(m_stream);
    throw SpeakerError("There is no sound: the sound output does not start");
  }
}

bool Speaker::plays() const
{
  const std::lock_guard<std::mutex> lock(calls);
  return Functions(m_library, kUsual).isActive(m_stream) == 1;
}

Speaker::~Speaker()
{
  const std::lock_guard<std::mutex> lock(calls);
  const Functions functions(m_library, kUsual); // was complete before
  functions.abortStream(m_stream);
  functions.closeStream(m_stream);
  functions.terminate();
  ::dlclose(m_library);
}

} // namespace petrous::sound
