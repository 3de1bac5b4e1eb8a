#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace petrous::volume
{

/// Union-find (Tarjan 1975) with path halving.
class DisjointSets
{
public:
  explicit DisjointSets(std::size_t count)
    : m_parent(count)
  {
    std::iota(m_parent.begin(), m_parent.end(), 0U);
  }

  std::uint32_t find(std::uint32_t n) noexcept
  {
    while (m_parent[n] != n)
      n = m_parent[n] = m_parent[m_parent[n]];
    return n;
  }

  void unite(std::uint32_t a, std::uint32_t b) noexcept { m_parent[find(b)] = find(a); }

private:
  std::vector<std::uint32_t> m_parent;
};

} // namespace petrous::volume
