#include "ItkMattes.h"

#include <algorithm>

#include <itkEuler3DTransform.h>
#include <itkImage.h>
#include <itkImageRegistrationMethodv4.h>
#include <itkMattesMutualInformationImageToImageMetricv4.h>
#include <itkRegistrationParameterScalesFromPhysicalShift.h>
#include <itkRegularStepGradientDescentOptimizerv4.h>
#include <itkVersion.h>

namespace petrous::registration::itkpeer
{

namespace
{

using ItkImage = itk::Image<float, 3>;
using Transform = itk::Euler3DTransform<double>;
using Metric = itk::MattesMutualInformationImageToImageMetricv4<ItkImage, ItkImage>;
using Method = itk::ImageRegistrationMethodv4<ItkImage, ItkImage, Transform>;

constexpr unsigned kLevels = 3;
constexpr double kShare = 0.1;        // of the voxels
constexpr double kSamples = 200000.0; // maximum, on the finest level

ItkImage::Pointer imageOf(const Image& from)
{
  auto image = ItkImage::New();
  ItkImage::RegionType region;
  ItkImage::DirectionType direction;
  itk::SizeValueType count = 1;
  for (unsigned a = 0; a < 3; ++a)
  {
    region.SetSize(a, static_cast<itk::SizeValueType>(from.dims[a]));
    count *= static_cast<itk::SizeValueType>(from.dims[a]);
    for (unsigned b = 0; b < 3; ++b)
      direction[a][b] = from.direction[3 * a + b];
  }
  image->SetRegions(region);
  image->SetSpacing(from.spacing.data());
  image->SetOrigin(from.origin.data());
  image->SetDirection(direction);
  image->GetPixelContainer()->SetImportPointer(from.voxels, count, false);
  return image;
}

} // namespace

bool register3d(const Image& fixed, const Image& moving, const std::array<double, 3>& center,
                std::array<double, 12>& matrix)
{
  auto metric = Metric::New();
  metric->SetNumberOfHistogramBins(32);
  auto scales = itk::RegistrationParameterScalesFromPhysicalShift<Metric>::New();
  scales->SetMetric(metric);
  auto optimizer = itk::RegularStepGradientDescentOptimizerv4<double>::New();
  optimizer->SetScalesEstimator(scales);
  optimizer->SetLearningRate(1.0);
  optimizer->SetMinimumStepLength(1e-4);
  optimizer->SetRelaxationFactor(0.5);
  optimizer->SetNumberOfIterations(200);

  auto transform = Transform::New();
  transform->SetCenter(center.data());

  auto method = Method::New();
  method->SetFixedImage(imageOf(fixed));
  method->SetMovingImage(imageOf(moving));
  method->SetMetric(metric);
  method->SetOptimizer(optimizer);
  method->SetInitialTransform(transform);
  method->InPlaceOn();
  method->SetNumberOfLevels(kLevels);
  Method::ShrinkFactorsArrayType shrink(kLevels);
  Method::SmoothingSigmasArrayType smooth(kLevels);
  for (unsigned level = 0; level < kLevels; ++level)
  {
    shrink[level] = 1U << (kLevels - 1 - level);
    smooth[level] = static_cast<double>(kLevels - 1 - level);
  }
  method->SetShrinkFactorsPerLevel(shrink);
  method->SetSmoothingSigmasPerLevel(smooth);
  method->SetMetricSamplingStrategy(Method::MetricSamplingStrategyEnum::RANDOM);
  method->SetMetricSamplingPercentage(
      std::min(kShare, kSamples / (1.0 * fixed.dims[0] * fixed.dims[1] * fixed.dims[2])));
  method->MetricSamplingReinitializeSeed(121212);
  try
  {
    method->Update();
  }
  catch (const itk::ExceptionObject&)
  {
    return false;
  }
  for (unsigned a = 0; a < 3; ++a)
  {
    for (unsigned b = 0; b < 3; ++b)
      matrix[4 * a + b] = transform->GetMatrix()[a][b];
    matrix[4 * a + 3] = transform->GetOffset()[a];
  }
  return true;
}

std::string version()
{
  return std::string("ITK ") + itk::Version::GetITKVersion() + " v4";
}

} // namespace petrous::registration::itkpeer
