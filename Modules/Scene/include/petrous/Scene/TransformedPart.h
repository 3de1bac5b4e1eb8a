#pragma once

#include <functional>
#include <memory>
#include <mutex>

#include "petrous/Core/RigidTransform.h"

namespace petrous::scene
{

/// Data drawn on an MR, transformed to CT space. Cached as long as the same data are requested with
/// the same transform, so that pointer comparison shows no change if there is none. Copies share
/// the cache. Thread-safe.
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
