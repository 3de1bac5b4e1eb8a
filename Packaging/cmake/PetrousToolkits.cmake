# ITK, GDCM, DCMTK and VTK as targets with SYSTEM includes, so that only modules that link them can include
# them, and their headers cause no warnings.

find_package(ITK 5.2 REQUIRED COMPONENTS
  ITKCommon ITKIOImageBase ITKIONRRD ITKIONIFTI ITKIOMeta ITKImageGrid ITKTransform
  ITKSmoothing ITKThresholding ITKStatistics)
add_library(petrous_itk INTERFACE)
target_include_directories(petrous_itk SYSTEM INTERFACE ${ITK_INCLUDE_DIRS})
target_link_libraries(petrous_itk INTERFACE ${ITK_LIBRARIES})
add_library(Petrous::itk ALIAS petrous_itk)

# ITK's series reader, only as peer of the import benchmark.
find_package(ITK 5.2 REQUIRED COMPONENTS ITKIOGDCM)
add_library(petrous_itk_gdcm INTERFACE)
target_include_directories(petrous_itk_gdcm SYSTEM INTERFACE ${ITK_INCLUDE_DIRS})
target_link_libraries(petrous_itk_gdcm INTERFACE ${ITK_LIBRARIES})
add_library(Petrous::itk_gdcm ALIAS petrous_itk_gdcm)

# ITK's registration, only as peer of the registration benchmark.
find_package(ITK 5.2 REQUIRED COMPONENTS ITKRegistrationMethodsv4)
add_library(petrous_itk_registration INTERFACE)
target_include_directories(petrous_itk_registration SYSTEM INTERFACE ${ITK_INCLUDE_DIRS})
target_link_libraries(petrous_itk_registration INTERFACE ${ITK_LIBRARIES})
add_library(Petrous::itk_registration ALIAS petrous_itk_registration)

# ITK's filters of masks, only as peers of the segmentation benchmark.
find_package(ITK 5.2 REQUIRED COMPONENTS
  ITKBinaryMathematicalMorphology ITKConnectedComponents ITKDistanceMap ITKLabelMap
  ITKMathematicalMorphology ITKRegionGrowing ITKSmoothing ITKThresholding)
add_library(petrous_itk_segmentation INTERFACE)
target_include_directories(petrous_itk_segmentation SYSTEM INTERFACE ${ITK_INCLUDE_DIRS})
target_link_libraries(petrous_itk_segmentation INTERFACE ${ITK_LIBRARIES})
add_library(Petrous::itk_segmentation ALIAS petrous_itk_segmentation)

add_library(petrous_gdcm INTERFACE)
target_include_directories(petrous_gdcm SYSTEM INTERFACE ${GDCM_INCLUDE_DIRS})
target_link_libraries(petrous_gdcm INTERFACE gdcmMSFF gdcmDICT gdcmDSED gdcmCommon)
add_library(Petrous::gdcm ALIAS petrous_gdcm)

# DCMTK as headers and libraries of the system: its own CMake targets name all that it was built
# with.
add_library(petrous_dcmtk INTERFACE)
target_link_libraries(petrous_dcmtk INTERFACE dcmdata oflog ofstd)
add_library(petrous_dcmtk_network INTERFACE)
target_link_libraries(petrous_dcmtk_network INTERFACE dcmtls dcmnet petrous_dcmtk OpenSSL::SSL OpenSSL::Crypto)
add_library(petrous_dcmtk_jpeg INTERFACE)
target_link_libraries(petrous_dcmtk_jpeg INTERFACE dcmjpeg ijg8 ijg12 ijg16 dcmimgle petrous_dcmtk)
add_library(Petrous::dcmtk ALIAS petrous_dcmtk)
add_library(Petrous::dcmtk_jpeg ALIAS petrous_dcmtk_jpeg)
add_library(Petrous::dcmtk_network ALIAS petrous_dcmtk_network)

find_package(VTK 9.1 REQUIRED COMPONENTS
  CommonCore CommonDataModel CommonColor CommonTransforms FiltersCore FiltersGeneral FiltersGeometry
  FiltersSources ImagingCore ImagingHybrid InteractionStyle IOImage IOGeometry IOPLY IOXML RenderingCore
  RenderingFreeType RenderingOpenGL2 RenderingVolume RenderingVolumeOpenGL2 glew)
find_package(OpenGL REQUIRED COMPONENTS EGL OpenGL)
if(PETROUS_WORKSTATION)
  find_package(Qt5 5.15 REQUIRED COMPONENTS Core Gui Widgets Test)
  find_package(Qt5LinguistTools 5.15 QUIET)
  find_package(VTK 9.1 REQUIRED COMPONENTS GUISupportQt)
endif()
