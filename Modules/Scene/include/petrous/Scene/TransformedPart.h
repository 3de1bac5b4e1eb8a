#pragma once

#include <functional>
#include <memory>
#include <mutex>

#include "petrous/Core/RigidTransform.h"

namespace petrous::scene
{

/// What was drawn on an MR, moved to where it lies on the CT. Kept as long as the same thing is
/// asked for at the same place, so that who compares pointers sees no change where there is none.
/// Copies occupancy what is kept. Thread-safe.
template <class T>
class TransformedPart
{
public:
  using Move = std::function<std::shared_ptr<const T>(const std::shared_ptr<const T>& drawn,
                                                      const core::RigidTransform& ctFromMr)>;

  std::shared_ptr<const T> at(const std::shared_ptr<const T>& drawn,
                              const core::RigidTransform& mrFromCt, const Move& move) const
  {
    const std::lock_guard<std::mutex> lock(m_state->mutex);
    State& state = *m_state;
    const bool same = state.moved && state.drawn == drawn &&
                      state.mrFromCt.rotation().coeffs() == mrFromCt.rotation().coeffs() &&
                      state.mrFromCt.translation() == mrFromCt.translation();
    if (!same)
    {
      state.moved = move(drawn, mrFromCt.inverse());
      state.drawn = drawn;
      state.mrFromCt = mrFromCt;
    }
    return state.moved;
  }

private:
  struct State
  {
    std::mutex mutex;
    std::shared_ptr<const T> drawn;
    core::RigidTransform mrFromCt;
    std::shared_ptr<const T> moved;
  };
  std::shared_ptr<State> m_state = std::make_shared<State>();
};

} // namespace petrous::scene
