#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace petrous::sound
{

/// What is heard of a drill.
struct DrillState
{
  bool running = false;
  double rpm = 60000.0; ///< of the free spindle
  int flutes = 8;       ///< of a cutting burr; 0: a diamond burr, which has none
  double load = 0.0;    ///< N, of the burr on tissue; 0: in air
  double wall = 5.0;    ///< mm of bone behind the burr, up to air or a structure
  bool warning = false; ///< adds a tone that repeats
};

/// A DrillState that one thread sets while another plays it. Each value is atomic; together they
/// may be of two moments a millisecond apart.
class DrillSignal
{
public:
  std::atomic<bool> running{false};
  std::atomic<double> rpm{60000.0};
  std::atomic<double> spindle{1.0}; ///< fraction of it that the pedal asks for
  std::atomic<int> flutes{8};
  std::atomic<double> load{0.0};
  std::atomic<double> wall{5.0};
  std::atomic<bool> warning{false};

  DrillState now() const noexcept;
};

/// Synthesises the sound of a drill, mono:
///   - harmonics of the spindle; of a cutting burr those of its teeth, flutes x rpm / 60, rise with
///     the load; the spindle slows down by up to kSag under it
///   - noise of the chips, by the load
///   - both through a low-pass filter of second order whose cut-off falls with the thickness of
///     the wall that remains: thin bone sounds brighter
/// What surgeons listen for is that the pitch changes with the wall; frequencies and levels are
/// plausible, not measured on bone.
///
/// Allocates nothing and never blocks. Not thread-safe.
class DrillVoice
{
public:
  static constexpr double kThick = 5.0;    ///< mm; thicker walls sound alike
  static constexpr double kSag = 0.06;     ///< of the speed, from kFullLoad on
  static constexpr double kFullLoad = 3.0; ///< N

  /// rate: samples a second, 8000 to 192000; throws InvalidParameter.
  explicit DrillVoice(double rate);

  /// Hz; at most what the rate can carry. Not a number counts as kThick.
  double cutoff(double wall) const noexcept;

  /// The next samples, -1 to 1, as the drill comes to be in that state: load and filter within some
  /// milliseconds, the spindle's speed within a fifth of a second.
  void render(const DrillState& state, float* samples, std::size_t count) noexcept;

private:
  void setFilter(double hertz) noexcept;
  double tone(const DrillState& state) noexcept;
  double noise() noexcept;
  double beep(bool warning) noexcept;

  double m_rate;
  double m_speed = 0.0; // of the spindle, 0 to 1
  double m_load = 0.0;  // 0 to 1
  double m_wall = kThick;
  double m_phase = 0.0;     // of the spindle, turns
  double m_beepTime = -1.0; // s since the tone began; negative: none
  std::uint32_t m_random = 1;
  std::array<double, 3> m_forward{}; // coefficients of the filter
  std::array<double, 2> m_back{};
  std::array<double, 2> m_delay{};
  std::size_t m_sinceFilter = 0; // samples
};

} // namespace petrous::sound
