#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <vector>

#include <tbb/parallel_for.h>

#include "PhantomScene.h"

namespace petrous::phantom
{
namespace
{

// As in Scene::stackAround: factors by which a distance may be wrong, outside and inside.
constexpr double kOutside = 1.3;
constexpr double kInside = 2.1;

double boxDistance(const shapes::Box& box, const shapes::Point& p)
{
  return std::max((box.min() - p).maxCoeff(), (p - box.max()).maxCoeff());
}

/// Volume of a layer in a cell, split in eight where it has a border, down to a resolution.
struct CellVolume
{
  double fine = 0.0;
  double coarse = 0.0; ///< the same at twice the resolution
};

CellVolume cellVolume(const Phantom::Scene& scene, std::size_t layer,
                      const Phantom::Scene::Stack& around, const shapes::Point& center,
                      const Eigen::Vector3d& edge, double resolution)
{
  const double width = std::cbrt(edge.prod());
  const auto covered = [&]
  {
    const double d = scene.distance(around, layer, center, 0.5 * width);
    return edge.prod() * std::clamp(0.5 - d / width, 0.0, 1.0);
  };
  if (width <= resolution)
  {
    const double volume = covered();
    return {volume, volume};
  }
  const auto stack = scene.stackAround(center, 0.5 * edge.norm(), &around, layer);
  if (stack.layers.empty())
  {
    const double volume = stack.base == static_cast<int>(layer) ? edge.prod() : 0.0;
    return {volume, volume};
  }
  if (scene.distance(stack, layer, center, Phantom::Scene::kFar) >= Phantom::Scene::kFar)
    return {};
  CellVolume sum;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d side((corner & 1) ? 0.25 : -0.25, (corner & 2) ? 0.25 : -0.25,
                               (corner & 4) ? 0.25 : -0.25);
    const CellVolume part =
        cellVolume(scene, layer, stack, center + edge.cwiseProduct(side), 0.5 * edge, resolution);
    sum.fine += part.fine;
    sum.coarse += part.coarse;
  }
  if (width <= 2.0 * resolution)
    sum.coarse = covered();
  return sum;
}

/// Marching tetrahedra over a lattice of signed distances to a layer within a box: closed by
/// construction, since every crossed edge gives one vertex and every crossed face one segment.
class Polygoniser
{
public:
  Polygoniser(const Phantom::Scene& scene, std::size_t layer, const shapes::Box& clip, double step)
    : m_scene(scene)
    , m_layer(layer)
    , m_clip(clip)
    , m_step(step)
  {
    const shapes::Box box = scene.layers[layer].shape.box.intersection(clip);
    m_origin = box.min().array() - 1.5 * step;
    for (std::size_t a = 0; a < 3; ++a)
    {
      m_dims[a] = static_cast<int>(std::ceil(box.sizes()[static_cast<Eigen::Index>(a)] / step)) + 4;
      m_blocks[a] = (m_dims[a] + kBlock - 1) / kBlock;
    }
    sample();
    cut();
  }

  core::TriangleMesh take() { return std::move(m_mesh); }

private:
  static constexpr int kBlock = 6;

  std::size_t index(int i, int j, int k) const
  {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(m_dims[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(m_dims[0]) +
           static_cast<std::size_t>(i);
  }
  shapes::Point at(double i, double j, double k) const
  {
    return m_origin + m_step * Eigen::Vector3d(i, j, k);
  }

  /// The layers near the block of a lattice point; they hold for the edges that begin there too.
  Phantom::Scene::Stack& stackOf(int i, int j, int k)
  {
    return m_stacks[(static_cast<std::size_t>(k / kBlock) * static_cast<std::size_t>(m_blocks[1]) +
                     static_cast<std::size_t>(j / kBlock)) *
                        static_cast<std::size_t>(m_blocks[0]) +
                    static_cast<std::size_t>(i / kBlock)];
  }
  double distance(const Phantom::Scene::Stack& stack, const shapes::Point& p) const
  {
    return std::max(m_scene.distance(stack, m_layer, p), boxDistance(m_clip, p));
  }

  /// Blocks without a border get one value everywhere.
  void sample()
  {
    m_values.resize(index(0, 0, m_dims[2]));
    m_stacks.resize(static_cast<std::size_t>(m_blocks[0]) * static_cast<std::size_t>(m_blocks[1]) *
                    static_cast<std::size_t>(m_blocks[2]));
    const double reach = 0.5 * std::sqrt(3.0) * kBlock * m_step;
    tbb::parallel_for(0, m_blocks[2],
                      [&](int slab)
                      {
                        const int k0 = slab * kBlock;
                        for (int j0 = 0; j0 < m_dims[1]; j0 += kBlock)
                          for (int i0 = 0; i0 < m_dims[0]; i0 += kBlock)
                            sampleBlock({i0, j0, k0}, reach);
                      });
  }

  void sampleBlock(const core::Index3& first, double reach)
  {
    const double half = 0.5 * (kBlock - 1);
    const shapes::Point center = at(first[0] + half, first[1] + half, first[2] + half);
    auto& stack = stackOf(first[0], first[1], first[2]);
    stack = m_scene.stackAround(center, reach, nullptr, m_layer);
    const double middle = distance(stack, center);
    const bool far = middle > kOutside * reach || middle < -kInside * reach;
    for (int k = first[2]; k < std::min(first[2] + kBlock, m_dims[2]); ++k)
      for (int j = first[1]; j < std::min(first[1] + kBlock, m_dims[1]); ++j)
        for (int i = first[0]; i < std::min(first[0] + kBlock, m_dims[0]); ++i)
          m_values[index(i, j, k)] =
              static_cast<float>(far ? middle : distance(stack, at(i, j, k)));
  }

  void cut()
  {
    // the six tetrahedra of a cube share the diagonal 0-7; corners are bits x, y, z
    static constexpr std::array<std::array<int, 4>, 6> kTetrahedra{
        {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}}};
    for (int k = 0; k + 1 < m_dims[2]; ++k)
      for (int j = 0; j + 1 < m_dims[1]; ++j)
        for (int i = 0; i + 1 < m_dims[0]; ++i)
        {
          unsigned inside = 0;
          for (int c = 0; c < 8; ++c)
            if (value(i, j, k, c) < 0.0F)
              inside |= 1U << c;
          if (inside == 0 || inside == 0xFF)
            continue;
          for (const auto& tetrahedron : kTetrahedra)
            cutTetrahedron(i, j, k, inside, tetrahedron);
        }
  }

  float value(int i, int j, int k, int corner) const
  {
    return m_values[index(i + (corner & 1), j + ((corner >> 1) & 1), k + (corner >> 2))];
  }

  void cutTetrahedron(int i, int j, int k, unsigned inside, const std::array<int, 4>& corners)
  {
    std::array<int, 4> in{};
    std::array<int, 4> out{};
    std::size_t ins = 0;
    std::size_t outs = 0;
    for (const int c : corners)
      ((inside >> c) & 1U) ? in[ins++] = c : out[outs++] = c;
    const auto vertex = [&](int a, int b) { return edgeVertex(i, j, k, a, b); };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c)
    {
      // oriented outwards: away from an inside corner
      const auto& v = m_mesh.vertices;
      const Eigen::Vector3d ref = at(i + (in[0] & 1), j + ((in[0] >> 1) & 1), k + (in[0] >> 2));
      const Eigen::Vector3d va = v[a].cast<double>();
      const Eigen::Vector3d normal = (v[b].cast<double>() - va).cross(v[c].cast<double>() - va);
      if (normal.dot(va - ref) >= 0.0)
        m_mesh.triangles.push_back({a, b, c});
      else
        m_mesh.triangles.push_back({a, c, b});
    };
    if (ins == 1)
      add(vertex(in[0], out[0]), vertex(in[0], out[1]), vertex(in[0], out[2]));
    else if (ins == 3)
      add(vertex(in[0], out[0]), vertex(in[1], out[0]), vertex(in[2], out[0]));
    else if (ins == 2)
    {
      const std::uint32_t a = vertex(in[0], out[0]);
      const std::uint32_t b = vertex(in[0], out[1]);
      const std::uint32_t c = vertex(in[1], out[1]);
      const std::uint32_t d = vertex(in[1], out[0]);
      add(a, b, c);
      add(a, c, d);
    }
  }

  /// Position of the border on an edge, by regula falsi on the signed distance itself.
  std::uint32_t edgeVertex(int i, int j, int k, int a, int b)
  {
    const int low = std::min(a, b);
    const int high = std::max(a, b);
    const std::size_t key = index(i + (low & 1), j + ((low >> 1) & 1), k + (low >> 2)) * 8 +
                            static_cast<std::size_t>(high - low);
    const auto [entry, fresh] =
        m_vertexOf.try_emplace(key, static_cast<std::uint32_t>(m_mesh.vertices.size()));
    if (!fresh)
      return entry->second;
    const shapes::Point p = at(i + (low & 1), j + ((low >> 1) & 1), k + (low >> 2));
    const shapes::Point q = at(i + (high & 1), j + ((high >> 1) & 1), k + (high >> 2));
    const auto& stack = stackOf(i + (low & 1), j + ((low >> 1) & 1), k + (low >> 2));
    double t0 = 0.0;
    double t1 = 1.0;
    double f0 = value(i, j, k, low);
    double f1 = value(i, j, k, high);
    double t = 0.5;
    for (int round = 0; round < 4; ++round)
    {
      t = std::clamp(t0 + (t1 - t0) * f0 / (f0 - f1), t0 + 0.05 * (t1 - t0), t1 - 0.05 * (t1 - t0));
      const double f = distance(stack, p + t * (q - p));
      if ((f < 0.0) == (f0 < 0.0))
      {
        t0 = t;
        f0 = f;
      }
      else
      {
        t1 = t;
        f1 = f;
      }
    }
    t = std::clamp(t0 + (t1 - t0) * f0 / (f0 - f1), 0.01, 0.99); // no two coincident vertices
    m_mesh.vertices.push_back((p + t * (q - p)).cast<float>());
    return entry->second;
  }

  const Phantom::Scene& m_scene;
  std::size_t m_layer;
  shapes::Box m_clip;
  Eigen::Vector3d m_origin;
  double m_step;
  core::Index3 m_dims{};
  core::Index3 m_blocks{};
  std::vector<Phantom::Scene::Stack> m_stacks;
  std::vector<float> m_values;
  std::unordered_map<std::size_t, std::uint32_t> m_vertexOf;
  core::TriangleMesh m_mesh;
};

} // namespace

double Phantom::volume(std::size_t structure, const core::PatientBox& within) const
{
  const shapes::Box box = m_scene->layers[m_scene->layerOf[structure]].shape.box.intersection(
      shapes::Box(within.min(), within.max()));
  if (box.isEmpty())
    return 0.0;
  const double mesh = m_scene->layers[m_scene->layerOf[structure]].mesh;
  const double resolution = mesh > 0.0 ? mesh : 0.2;
  const Eigen::Vector3d size = box.sizes();
  const Eigen::Array3i cells = (size.array() / 2.0).ceil().cast<int>().max(1);
  const Eigen::Vector3d edge = size.array() / cells.cast<double>();
  const std::size_t layer = m_scene->layerOf[structure];

  // one sum per layer of cells, added in order: independent of thread scheduling
  std::vector<CellVolume> sums(static_cast<std::size_t>(cells[2]));
  tbb::parallel_for(
      0, cells[2],
      [&](int k)
      {
        CellVolume& sum = sums[static_cast<std::size_t>(k)];
        for (int j = 0; j < cells[1]; ++j)
          for (int i = 0; i < cells[0]; ++i)
          {
            const shapes::Point center =
                box.min() + edge.cwiseProduct(Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5));
            const auto stack = m_scene->stackAround(center, 0.5 * edge.norm(), nullptr, layer);
            const CellVolume part = cellVolume(*m_scene, layer, stack, center, edge, resolution);
            sum.fine += part.fine;
            sum.coarse += part.coarse;
          }
      });
  CellVolume all;
  for (const CellVolume& sum : sums)
  {
    all.fine += sum.fine;
    all.coarse += sum.coarse;
  }
  // The coverage error of a border cell is proportional to the square of its edge where the border
  // is curved: two edges, one twice the other, cancel it (Richardson extrapolation).
  return (4.0 * all.fine - all.coarse) / 3.0;
}

core::TriangleMesh Phantom::surface(std::size_t structure, const core::PatientBox& within,
                                    double resolution) const
{
  const anatomy::Layer& layer = m_scene->layers[m_scene->layerOf[structure]];
  const shapes::Box clip(within.min(), within.max());
  if (layer.shape.box.intersection(clip).isEmpty())
    return {};
  const double step = resolution > 0.0 ? resolution : (layer.mesh > 0.0 ? layer.mesh : 0.3);
  return Polygoniser(*m_scene, m_scene->layerOf[structure], clip, step).take();
}

} // namespace petrous::phantom
