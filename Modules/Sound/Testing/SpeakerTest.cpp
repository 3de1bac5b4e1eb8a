#include "petrous/Sound/Speaker.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include <dlfcn.h>

#include <gtest/gtest.h>

#include "petrous/Sound/DrillVoice.h"

using namespace petrous;
using namespace petrous::sound;

namespace
{

class SpeakerTest : public ::testing::Test
{
protected:
  SpeakerTest()
    : m_library(::dlopen(PETROUS_STANDIN_PORTAUDIO, RTLD_NOW | RTLD_LOCAL))
  {
    ::setenv("PETROUS_PORTAUDIO", PETROUS_STANDIN_PORTAUDIO, 1);
  }
  ~SpeakerTest() override
  {
    ::unsetenv("PETROUS_PORTAUDIO");
    ::unsetenv("PETROUS_STANDIN_SOUND_FAULT");
    ::dlclose(m_library);
  }

  template <class Signature>
  Signature* function(const char* name)
  {
    return reinterpret_cast<Signature*>(::dlsym(m_library, name));
  }
  double play() // loudness of the next block; negative: nothing plays
  {
    std::array<float, Speaker::kBlock> samples{};
    if (function<unsigned long(float*)>("standin_play")(samples.data()) != samples.size())
      return -1.0;
    double sum = 0.0;
    for (const float sample : samples)
      sum += static_cast<double>(sample) * static_cast<double>(sample);
    return std::sqrt(sum / static_cast<double>(samples.size()));
  }

  DrillSignal m_signal;
  Speaker::Fill fillFor(double rate)
  {
    return [this, voice = DrillVoice(rate)](float* samples, std::size_t count) mutable
    { voice.render(m_signal.now(), samples, count); };
  }
  std::string refusal()
  {
    try
    {
      const Speaker speaker([this](double rate) { return fillFor(rate); });
    }
    catch (const SpeakerError& error)
    {
      return error.what();
    }
    return "plays";
  }

  void* m_library;
};

} // namespace

TEST_F(SpeakerTest, PlaysWhatTheSignalSaysInTheNextBlocks)
{
  ASSERT_NE(m_library, nullptr);
  {
    const Speaker speaker([this](double rate) { return fillFor(rate); });
    EXPECT_EQ(function<double()>("standin_rate")(), 48000.0);
    EXPECT_EQ(play(), 0.0);
    EXPECT_TRUE(speaker.plays());
    m_signal.running = true;
    for (int block = 0; block < 100; ++block)
      play();
    const double inAir = play();
    EXPECT_GT(inAir, 0.0);
    m_signal.load = 2.0;
    m_signal.wall = 0.5;
    play();
    EXPECT_GT(play(), 2.0 * inAir) << "10.7 ms after contact";
    ::setenv("PETROUS_STANDIN_SOUND_FAULT", "gone", 1);
    EXPECT_FALSE(speaker.plays());
  }
  EXPECT_LT(play(), 0.0);
  EXPECT_EQ(function<int()>("standin_initialized")(), 0);
}

TEST_F(SpeakerTest, TakesTheRateOfACardThatHasOneOnly)
{
  ::setenv("PETROUS_STANDIN_SOUND_FAULT", "rate", 1);
  const Speaker speaker([this](double rate) { return fillFor(rate); });
  EXPECT_EQ(function<double()>("standin_rate")(), 44100.0);
}

TEST_F(SpeakerTest, SaysWhyThereIsNoSoundAndLeavesNothingBehind)
{
  for (const auto& [fault, why] :
       {std::pair{"initialize", "no sound system"}, std::pair{"nothing", "no sound output"},
        std::pair{"open", "cannot be opened"}, std::pair{"start", "does not start"}})
  {
    ::setenv("PETROUS_STANDIN_SOUND_FAULT", fault, 1);
    EXPECT_NE(refusal().find(why), std::string::npos) << refusal();
    EXPECT_EQ(function<int()>("standin_initialized")(), 0) << fault;
  }
  ::unsetenv("PETROUS_STANDIN_SOUND_FAULT");
  ::setenv("PETROUS_PORTAUDIO", "/nowhere/libportaudio.so", 1);
  EXPECT_NE(refusal().find("libportaudio2"), std::string::npos);
  ::setenv("PETROUS_PORTAUDIO", "libm.so.6", 1);
  EXPECT_NE(refusal().find("Pa_Initialize"), std::string::npos);
}
