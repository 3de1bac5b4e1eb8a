#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "petrous/Core/Error.h"

namespace petrous::sound
{

/// There is no sound to be had. The message says what is missing.
class SpeakerError : public core::Error
{
public:
  explicit SpeakerError(const std::string& message);
};

/// Plays mono sound on the system's default output through PortAudio 19, which is loaded when the
/// first speaker is made (environment variable PETROUS_PORTAUDIO, or libportaudio.so.2) and
/// unloaded with it: without one there is no thread and no library.
class Speaker
{
public:
  /// Fills samples, -1 to 1; called in PortAudio's thread: it must neither block nor throw.
  using Fill = std::function<void(float* samples, std::size_t count)>;

  /// `fill` makes it for a rate, samples a second. Takes up to some seconds, while PortAudio looks
  /// for cards. Throws SpeakerError, and what `fill` throws.
  explicit Speaker(const std::function<Fill(double rate)>& fill);
  ~Speaker(); ///< silent at once
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;

  /// False once the output has gone: a headset pulled out, a sound server that ended.
  bool plays() const;

  /// Samples that are asked for at once: 5.3 ms at 48 kHz.
  static constexpr unsigned long kBlock = 256;

private:
  struct Functions;
  void open(const Functions& functions, const std::function<Fill(double rate)>& fill);

  Fill m_fill;
  void* m_library = nullptr;
  void* m_stream = nullptr;
};

} // namespace petrous::sound
