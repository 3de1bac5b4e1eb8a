#include "petrous/Volume/PublishedMask.h"

#include <algorithm>

namespace petrous::volume
{

MaskState::MaskState(const CutMask& mask, std::uint64_t number)
  : m_blocks((mask.brickCount() + kBlock - 1) / kBlock)
  , m_number(number)
{
  for (std::size_t b = 0; b < m_blocks.size(); ++b)
  {
    Block block;
    bool any = false;
    for (std::size_t n = 0; n < kBlock && b * kBlock + n < mask.brickCount(); ++n)
    {
      block[n] = mask.brick(b * kBlock + n);
      any = any || block[n];
    }
    if (any)
      m_blocks[b] = std::make_shared<const Block>(std::move(block));
  }
}

MaskState::MaskState(const MaskState& previous, const CutMask& mask,
                     const std::vector<std::size_t>& bricks)
  : m_blocks(previous.m_blocks)
  , m_number(previous.m_number + 1)
  , m_raises(previous.m_raises)
{
  std::vector<std::size_t> blocks;
  for (const std::size_t brick : bricks)
    blocks.push_back(brick / kBlock);
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  for (const std::size_t b : blocks)
  {
    auto block = m_blocks[b] ? std::make_shared<Block>(*m_blocks[b]) : std::make_shared<Block>();
    for (const std::size_t brick : bricks)
      if (brick / kBlock == b)
        (*block)[brick % kBlock] = mask.brick(brick);
    m_blocks[b] = std::move(block);
  }
}

PublishedMask::PublishedMask(const CutMask& mask, std::uint64_t number)
  : m_geometry(mask.geometry())
  , m_brickDims(mask.brickDims())
{
  m_states.push_back(std::make_unique<const MaskState>(mask, number));
  m_present.store(m_states.back().get());
}

void PublishedMask::publish(const CutMask& mask, const std::vector<std::size_t>& bricks,
                            bool raised)
{
  if (bricks.empty())
    return;
  auto next = std::make_unique<MaskState>(*m_states.back(), mask, bricks);
  if (raised)
    next->raise();
  m_states.push_back(std::move(next));
  m_present.store(m_states.back().get());
  // Sequentially consistent with acquire: a reader either is seen here or sees the new state.
  const MaskState* held = m_held.load();
  m_states.erase(std::remove_if(m_states.begin(), m_states.end() - 1,
                                [held](const auto& state) { return state.get() != held; }),
                 m_states.end() - 1);
}

const MaskState* PublishedMask::acquire() const noexcept
{
  const MaskState* state = m_present.load();
  // The writer may replace a state between load and store; it is safe only once it is held and
  // still current. A cut takes longer than this loop, so it runs once, rarely twice.
  for (;;)
  {
    m_held.store(state);
    const MaskState* again = m_present.load();
    if (again == state)
      return state;
    state = again;
  }
}

void PublishedMask::release() const noexcept
{
  m_held.store(nullptr);
}

} // namespace petrous::volume
