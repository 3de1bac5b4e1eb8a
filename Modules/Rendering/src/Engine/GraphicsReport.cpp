#include "petrous/Rendering/GraphicsReport.h"

#include <algorithm>
#include <functional>

#include <vtkNew.h>
#include <vtk_glew.h>

#include "petrous/Core/Error.h"
#include "petrous/Rendering/EglRenderWindow.h"
#include "petrous/Rendering/OffscreenView.h"

namespace petrous::rendering
{

namespace
{

constexpr int kEdge = 8; // voxels and pixels

core::GridGeometry grid()
{
  return {{kEdge, kEdge, kEdge}, Eigen::Vector3d::Ones(), Eigen::Vector3d::Zero()};
}

template <class T>
std::shared_ptr<const volume::Volume<T>> filled(T value)
{
  return std::make_shared<const volume::Volume<T>>(grid(), value);
}

volume::CutMask::Brick cutBrick()
{
  volume::CutMask::Brick brick;
  brick.fill(volume::CutMask::kUntouched);
  brick.front() = 0;
  return brick;
}

std::shared_ptr<volume::LabelField> labelField()
{
  auto labels = std::make_shared<volume::LabelField>();
  labels->occupancy = filled(0.0F);
  labels->index = filled<std::uint8_t>(0);
  return labels;
}

using Change = std::function<void(SceneContents&)>;

// Contents that make the mapper compile each of its features.
std::vector<Change> features()
{
  const auto materials = [](SceneContents& contents)
  {
    if (contents.materials.empty())
      contents.materials.emplace_back();
  };
  return {[](SceneContents& contents) { contents.labels = labelField(); },
          [](SceneContents& contents)
          {
            auto labels = labelField();
            labels->borders = filled<std::uint8_t>(0);
            contents.labels = labels;
          },
          [materials](SceneContents& contents)
          {
            materials(contents);
            contents.materials.emplace_back().surfaceOpacity = 0.5F;
            if (!contents.labels)
              contents.labels = labelField();
          },
          [](SceneContents& contents)
          {
            auto mask = std::make_shared<volume::CutMask>(grid());
            mask->setBrick(0, std::make_shared<const volume::CutMask::Brick>(cutBrick()));
            contents.mask = mask;
          },
          [materials](SceneContents& contents)
          {
            materials(contents);
            contents.second.volume = contents.ct;
            contents.materials.front().source = appearance::IntensitySource::Second;
          },
          [materials](SceneContents& contents)
          {
            materials(contents);
            contents.third.volume = contents.ct;
            contents.materials.front().source = appearance::IntensitySource::Third;
          },
          [materials](SceneContents& contents)
          {
            materials(contents);
            contents.materials.front().surfaceOpacity = 0.5F;
          },
          [](SceneContents& contents) { contents.thickness.distance = filled<float>(1.0F); },
          [](SceneContents& contents) { contents.clipping.emplace_back(); }};
}

GraphicsReport::Variant drawn(const SceneContents& contents, int& filterBits)
{
  GraphicsReport::Variant variant;
  ScenePicture picture;
  try
  {
    OffscreenView view(kEdge, kEdge);
    picture.setContents(contents);
    core::CameraPose camera;
    camera.focalPoint = Eigen::Vector3d::Constant(0.5 * kEdge);
    camera.position = camera.focalPoint - Eigen::Vector3d(0.0, 4.0 * kEdge, 0.0);
    picture.setCamera(camera);
    view.render(picture);
    variant.compiles = true;
  }
  catch (const core::Error& error)
  {
    variant.error = error.what();
  }
  variant.features = picture.statistics().variant;
  filterBits = std::max(filterBits, picture.statistics().filterBits);
  return variant;
}

} // namespace

GraphicsReport reportGraphics()
{
  GraphicsReport report;
  {
    vtkNew<vtkPetrousEGLRenderWindow> window;
    window->SetSize(kEdge, kEdge);
    window->Initialize();
    const auto text = [](GLenum what)
    {
      const auto* words = reinterpret_cast<const char*>(glGetString(what));
      return std::string(words ? words : "unknown");
    };
    report.renderer = text(GL_RENDERER);
    report.version = text(GL_VERSION);
    GLint largest = 0;
    glGetIntegerv(GL_MAX_3D_TEXTURE_SIZE, &largest);
    report.largestTexture3d = largest;
    window->ReleaseCurrent();
  }
  SceneContents plain;
  plain.ct = std::make_shared<const volume::IntensityVolume>(filled<std::int16_t>(-1000));
  report.variants.push_back(drawn(plain, report.filterBits));
  SceneContents all = plain;
  for (const Change& add : features())
  {
    SceneContents one = plain;
    add(one);
    report.variants.push_back(drawn(one, report.filterBits));
    add(all);
  }
  report.variants.push_back(drawn(all, report.filterBits));
  return report;
}

} // namespace petrous::rendering
