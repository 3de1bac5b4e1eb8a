#include "petrous/Imaging/MeshFile.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include "TestFiles.h"
#include "petrous/Volume/MeshMeasure.h"

namespace petrous::imaging
{
namespace
{

using Reason = FileError::Reason;

/// A box from (10, 20, 30), 2 x 3 x 4 mm: volume 24 mm^3, faces oriented outwards.
const char* const kBoxObj = "# a box of quadrangles\n"
                            "v 10 20 30\nv 12 20 30\nv 12 23 30\nv 10 23 30\n"
                            "v 10 20 34\nv 12 20 34\nv 12 23 34\nv 10 23 34\n"
                            "vt 0 0\nvn 0 0 1\no box\ns off\nusemtl bone\n"
                            "f 1 4 3 2\nf 5/1 6/1 7/1 8/1\nf 1//1 2//1 6//1 5//1\n"
                            "f 2/1/1 3/1/1 7/1/1 6/1/1\nf -6 -5 -1 \\\n -2\nf 4 1 5 8\n";

core::TriangleMesh boxOf(const TestFolder& folder)
{
  return readMesh(putFile(folder / "box.obj", kBoxObj));
}

void expectBox(const core::TriangleMesh& mesh)
{
  EXPECT_EQ(mesh.vertices.size(), 8U);
  EXPECT_EQ(mesh.triangles.size(), 12U);
  EXPECT_TRUE(mesh.isClosed());
  EXPECT_NEAR(mesh.signedVolume(), 24.0, 1e-9);
  EXPECT_EQ(mesh.bounds()[0], Eigen::Vector3f(10.0F, 20.0F, 30.0F));
  EXPECT_EQ(mesh.bounds()[1], Eigen::Vector3f(12.0F, 23.0F, 34.0F));
}

TEST(MeshFile, RefusesAFileThatStatesBothFrames)
{
  const TestFolder folder;
  const auto file = putFile(folder / "both.obj", "# SPACE=LPS\n# SPACE=RAS\nv 1 2 3\nv 4 2 3\n"
                                                 "v 1 5 3\nf 1 2 3\n");
  try
  {
    loadMesh(file);
    ADD_FAILURE() << "one of the two was believed";
  }
  catch (const FileError& error)
  {
    EXPECT_EQ(error.reason, FileError::Reason::NoGeometry);
  }
  EXPECT_EQ(loadMesh(file, true).mesh.vertices[0], Eigen::Vector3f(-1.0F, -2.0F, 3.0F));
}

TEST(MeshFile, SplitsAFileByItsObjects)
{
  const TestFolder folder;
  // The box and a tetrahedron of 1/6 mm^3 that shares its corner 7, their faces in turns, with
  // quadrangles, faces that are no triangle, and a vertex of no face.
  const LoadedMesh loaded = loadMesh(
      putFile(folder / "turns.obj",
              "v 10 20 30\nv 12 20 30\nv 12 23 30\nv 10 23 30\nv 10 20 34\nv 12 20 34\nv 12 23 34\n"
              "v 10 23 34\nv 99 99 99\nv 13 23 34\nv 12 24 34\nv 12 23 35\n"
              "g box\nf 1 4 3 2\ng tip\nf 7 11 10\nf 7 7 10\ng box\nf 1 1 2\nf 5 6 7 8\n"
              "g tip\nf 7 10 12\ng none\nf 1 1 2\ng box\nf 1 2 6 5\nf 2 3 7 6\n"
              "g tip\nf 7 12 11\nf 10 11 12\ng box\nf 3 4 8 7\nf 4 1 5 8\n"));
  EXPECT_EQ(loaded.objects, (std::vector<std::string>{"box", "tip"}));
  EXPECT_EQ(loaded.objectOf,
            (std::vector<std::uint32_t>{0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0}));
  const auto parts = splitByObject(loaded);
  ASSERT_EQ(parts.size(), 2U);
  expectBox(parts[0]);
  EXPECT_EQ(parts[1].vertices.size(), 4U);
  EXPECT_EQ(parts[1].triangles.size(), 4U);
  EXPECT_TRUE(parts[1].isClosed());
  EXPECT_NEAR(volume::measure(parts[0]).volume.value(), 24.0, 1e-5);
  EXPECT_NEAR(volume::measure(parts[1]).volume.value(), 1.0 / 6.0, 1e-5);
  EXPECT_NEAR(loaded.mesh.signedVolume(), 24.0 + 1.0 / 6.0, 1e-5);

  const LoadedMesh one = loadMesh(putFile(folder / "box.obj", kBoxObj));
  EXPECT_TRUE(one.objectOf.empty());
  EXPECT_EQ(objectCount(folder / "box.obj"), 1U);
  EXPECT_EQ(objectCount(folder / "turns.obj"), 2U);
  ASSERT_EQ(splitByObject(one).size(), 1U);
  EXPECT_EQ(splitByObject(one)[0].triangles, one.mesh.triangles);
}

TEST(MeshFile, SplitsSolidsThatShareAVertexAndAName)
{
  const TestFolder folder;
  using Corner = std::array<int, 3>;
  const auto facet = [](const Corner& a, const Corner& b, const Corner& c)
  {
    std::string text = "facet normal 0 0 0\nouter loop\n";
    for (const Corner& p : {a, b, c})
      text += "vertex " + std::to_string(p[0]) + " " + std::to_string(p[1]) + " " +
              std::to_string(p[2]) + "\n";
    return text + "endloop\nendfacet\n";
  };
  const auto tetrahedron = [&facet](int x) // from (x, 0, 0)
  {
    const Corner a{x, 0, 0};
    const Corner b{x + 1, 0, 0};
    const Corner c{x, 1, 0};
    const Corner d{x, 0, 1};
    return facet(a, c, b) + facet(a, a, b) + facet(a, b, d) + facet(a, d, c) + facet(b, c, d);
  };
  const LoadedMesh loaded =
      loadMesh(putFile(folder / "two.stl",
                       "solid nothing\nendsolid nothing\nsolid bone\n" + tetrahedron(0) +
                           "endsolid bone\nsolid flat\n" + facet({0, 0, 0}, {0, 0, 0}, {1, 0, 0}) +
                           "endsolid flat\nsolid bone\n" + tetrahedron(1) + "endsolid bone\n"));
  EXPECT_EQ(loaded.objects, (std::vector<std::string>{"bone", "bone"}));
  EXPECT_EQ(objectCount(folder / "two.stl"), 2U);
  writeMesh(folder / "binary.stl", loaded.mesh);
  EXPECT_EQ(objectCount(folder / "binary.stl"), 1U);
  EXPECT_EQ(loaded.objectOf, (std::vector<std::uint32_t>{0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(loaded.mesh.vertices.size(), 7U) << "one is shared";
  const auto parts = splitByObject(loaded);
  ASSERT_EQ(parts.size(), 2U);
  for (const core::TriangleMesh& part : parts)
  {
    EXPECT_EQ(part.vertices.size(), 4U);
    EXPECT_TRUE(part.isClosed());
    EXPECT_NEAR(part.signedVolume(), 1.0 / 6.0, 1e-6);
  }
  EXPECT_EQ(parts[0].bounds()[1], Eigen::Vector3f(1.0F, 1.0F, 1.0F));
  EXPECT_EQ(parts[1].bounds()[0], Eigen::Vector3f(1.0F, 0.0F, 0.0F));
}

TEST(MeshFile, NamesTheObjectsThatHaveTriangles)
{
  const TestFolder folder;
  const auto objects = [&folder](const char* name, const std::string& text)
  { return loadMesh(putFile(folder / name, text)).objects; };
  using Names = std::vector<std::string>;
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_EQ(objects("a.obj", corners + "g sinus\nf 1 2 3\ng empty\ng facial nerve\nf 1 3 2\n"
                                       "g sinus\nf 2 3 1\n"),
            (Names{"sinus", "facial nerve"}));
  EXPECT_EQ(objects("b.obj", "o one\ng left\n" + corners + "f 1 2 3\no two\nf 1 3 2\n"),
            (Names{"one", "two"}));
  EXPECT_EQ(objects("c.obj", corners + "f 1 2 3\n").size(), 1U);
  const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                            "vertex 0 1 0\nendloop\nendfacet\n";
  EXPECT_EQ(objects("a.stl", "solid malleus\n" + facet + facet + "endsolid malleus\nsolid incus\n" +
                                 facet + "endsolid incus\n"),
            (Names{"malleus", "incus"}));
}

TEST(MeshFile, ReadsObjPolygonsAndEveryFormOfCorner)
{
  const TestFolder folder;
  expectBox(boxOf(folder));
  std::string dos(kBoxObj);
  for (std::size_t at = 0; (at = dos.find('\n', at)) != dos.npos; at += 2)
    dos.insert(at, "\r");
  dos.replace(dos.find("\\\r"), 2, ""); // the continued line is joined
  dos.replace(dos.find("\n -2"), 4, " -2");
  expectBox(readMesh(putFile(folder / "dos.OBJ", dos)));
}

TEST(MeshFile, EveryFormatKeepsTheSurface)
{
  const TestFolder folder;
  const core::TriangleMesh box = boxOf(folder);
  for (const std::string end : {".obj", ".stl", ".ply"})
  {
    writeMesh(folder / ("a" + end), box);
    writeMesh(folder / ("b" + end), box);
    expectBox(readMesh(folder / ("a" + end)));
    EXPECT_EQ(fileBytes(folder / ("a" + end)), fileBytes(folder / ("b" + end)));
    EXPECT_NE(fileBytes(folder / ("a" + end)).find("SPACE=LPS"), std::string::npos);
    EXPECT_TRUE(loadMesh(folder / ("a" + end)).notes.empty());
  }
}

TEST(MeshFile, PlyKeepsTheSurfaceBesideAColour)
{
  const TestFolder folder;
  writeMesh(folder / "a.ply", boxOf(folder), std::array<float, 3>{1.0F, 0.5F, 0.0F});
  expectBox(readMesh(folder / "a.ply"));
  const std::string bytes = fileBytes(folder / "a.ply");
  EXPECT_NE(bytes.find("property uchar red\nproperty uchar green\nproperty uchar blue\n"),
            bytes.npos);
  const std::size_t first = bytes.find("end_header\n") + 11;
  EXPECT_EQ(bytes.substr(first + 12, 3), std::string("\xff\x80\0", 3));
}

TEST(MeshFile, ObjAndPlyKeepEveryBitOfAVertex)
{
  const TestFolder folder;
  core::TriangleMesh mesh;
  mesh.vertices = {{0.1F, 1.0F / 3.0F, 1e-30F}, {1.2345678e7F, -0.7F, 3.0F}, {5.0F, 6.0F, 7.1F}};
  mesh.triangles = {{0, 1, 2}};
  for (const char* name : {"a.obj", "a.ply"})
  {
    writeMesh(folder / name, mesh);
    EXPECT_EQ(readMesh(folder / name).vertices, mesh.vertices) << name;
  }
}

// Cancelled when the file is in memory, so that the parser has to notice.
TEST(MeshFile, StopsWithinAFile)
{
  const TestFolder folder;
  core::TriangleMesh mesh;
  constexpr std::uint32_t kMany = 70000; // more than lie between two checks
  for (std::uint32_t v = 0; v < kMany; ++v)
    mesh.vertices.emplace_back(static_cast<float>(v), static_cast<float>(v % 7), 0.0F);
  for (std::uint32_t v = 0; v + 2 < kMany; ++v)
    mesh.triangles.push_back({v, v + 1, v + 2});
  std::string text = "solid a\n";
  for (int v = 0; v < 12000; ++v)
    text += "facet normal 0 0 1\nouter loop\nvertex " + std::to_string(v) +
            " 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n";
  putFile(folder / "text.stl", text + "endsolid a\n");
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const auto& v : mesh.vertices)
    points->InsertNextPoint(v[0], v[1], v[2]);
  for (const auto& t : mesh.triangles)
    cells->InsertNextCell({t[0], t[1], t[2]});
  vtkNew<vtkPolyData> poly;
  poly->SetPoints(points);
  poly->SetPolys(cells);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(poly);
  writer->SetFileName((folder / "a.vtp").c_str());
  ASSERT_EQ(writer->Write(), 1);
  for (const char* name : {"a.obj", "a.ply", "a.stl"})
    writeMesh(folder / name, mesh);
  for (const char* name : {"a.obj", "a.ply", "a.stl", "text.stl", "a.vtp"})
  {
    EXPECT_NO_THROW(loadMesh(folder / name)) << name;
    const auto token = std::make_shared<core::CancelToken>();
    bool isParsing = false;
    const core::Progress progress(
        [&](double, const std::string& task)
        {
          isParsing = task == "reading mesh";
          if (isParsing)
            token->cancel();
        },
        token);
    EXPECT_THROW(loadMesh(folder / name, {}, {}, progress), core::CancelledError) << name;
    EXPECT_TRUE(isParsing) << name;
  }
}

TEST(MeshFile, ReadsTextStlAndMergesEqualCorners)
{
  const TestFolder folder;
  const std::string facets =
      "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n"
      " endloop\nendfacet\n"
      "facet normal 0 0 1\n outer loop\n  vertex 1 0 -0\n  vertex 1 1 0\n  vertex 0 1 0\n"
      " endloop\nendfacet\n";
  const auto loaded =
      loadMesh(putFile(folder / "a.stl", "solid part\n" + facets + "endsolid part\n"));
  EXPECT_EQ(loaded.mesh.vertices.size(), 4U);
  EXPECT_EQ(loaded.mesh.triangles.size(), 2U);
  expectRefused(refusalOf([&] { readMesh(putFile(folder / "b.stl", "solid part\n" + facets)); }),
                Reason::Unreadable, "endsolid");
}

TEST(MeshFile, TurnsRasIntoLpsAndNotesIt)
{
  const TestFolder folder;
  const std::string body = "v 1 2 3\nv 4 2 3\nv 1 5 3\nf 1 2 3\n";
  const auto ras = loadMesh(putFile(folder / "ras.obj", "# 3D Slicer output. SPACE=RAS\n" + body));
  const auto lps = loadMesh(putFile(folder / "lps.obj", "# 3D Slicer output. SPACE=LPS\n" + body));
  EXPECT_EQ(ras.mesh.vertices[1], Eigen::Vector3f(-4.0F, -2.0F, 3.0F));
  EXPECT_EQ(lps.mesh.vertices[1], Eigen::Vector3f(4.0F, 2.0F, 3.0F));
  EXPECT_EQ(ras.mesh.triangles, lps.mesh.triangles); // a half turn preserves orientation
  EXPECT_EQ(ras.notes.size(), 1U);
  EXPECT_TRUE(lps.notes.empty());
  const core::TriangleMesh box = boxOf(folder);
  writeMesh(folder / "a.stl", box);
  std::string stl = fileBytes(folder / "a.stl");
  stl.replace(stl.find("SPACE=LPS"), 9, "SPACE=RAS");
  const auto turned = loadMesh(putFile(folder / "b.stl", stl));
  EXPECT_EQ(turned.mesh.bounds()[0], Eigen::Vector3f(-12.0F, -23.0F, 30.0F));
  EXPECT_NEAR(turned.mesh.signedVolume(), 24.0, 1e-9);
}

TEST(MeshFile, ReadsTextPlyWithOtherProperties)
{
  const TestFolder folder;
  const auto mesh = readMesh(
      putFile(folder / "a.ply",
              "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\n"
              "property float nx\nproperty double x\nproperty double y\nproperty double z\n"
              "property uchar red\nelement edge 1\nproperty int a\nproperty int b\n"
              "element face 1\nproperty uchar flag\nproperty list uchar int vertex_index\n"
              "end_header\n9 0 0 0 255\n9 1 0 0 255\n9 1 1 0 255\n9 0 1 0 255\n0 1\n"
              "7 4 0 1 2 3\n"));
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.vertices[2], Eigen::Vector3f(1.0F, 1.0F, 0.0F));
  EXPECT_EQ(mesh.triangles, (std::vector<std::array<std::uint32_t, 3>>{{{0, 1, 2}}, {{0, 2, 3}}}));
}

TEST(MeshFile, ReadsBigEndianPly)
{
  const TestFolder folder;
  std::string bytes = "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\n"
                      "property float y\nproperty float z\nelement face 1\n"
                      "property list uint8 int32 vertex_indices\nend_header\n";
  const auto put = [&bytes](auto value)
  {
    std::string raw = bytesOf(std::vector<decltype(value)>{value});
    std::reverse(raw.begin(), raw.end());
    bytes += raw;
  };
  for (const float c : {0.0F, 0.0F, 0.0F, 1.5F, 0.0F, 0.0F, 0.0F, -2.5F, 0.0F})
    put(c);
  put(std::uint8_t{3});
  for (const std::int32_t corner : {0, 1, 2})
    put(corner);
  const auto mesh = readMesh(putFile(folder / "a.ply", bytes));
  EXPECT_EQ(mesh.vertices[1], Eigen::Vector3f(1.5F, 0.0F, 0.0F));
  EXPECT_EQ(mesh.vertices[2], Eigen::Vector3f(0.0F, -2.5F, 0.0F));
}

TEST(MeshFile, NeverBelievesAnAbsurdCount)
{
  const TestFolder folder;
  const std::string start = "ply\nformat binary_little_endian 1.0\nelement vertex ";
  const std::string end = "\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                          "property list uchar int vertex_indices\nend_header\nabcdefghijkl";
  for (const char* count : {"1000000000000", "9223372036854775807", "99999999999999999999", "-1"})
    expectRefused(refusalOf([&] { readMesh(putFile(folder / "a.ply", start + count + end)); }),
                  Reason::Unreadable);
  expectRefused(refusalOf(
                    [&]
                    {
                      readMesh(putFile(folder / "b.ply", "ply\nformat ascii 1.0\nelement void "
                                                         "1000000000000\nend_header\n"));
                    }),
                Reason::Unreadable, "more than the file can hold");
  std::string stl(80, ' ');
  stl += bytesOf(std::vector<std::uint32_t>{4000000000U});
  expectRefused(refusalOf([&] { readMesh(putFile(folder / "a.stl", stl)); }), Reason::Unreadable,
                "4000000000");
}

TEST(MeshFile, RefusesDamagedFilesInWords)
{
  const TestFolder folder;
  const std::pair<const char*, std::string> bad[] = {
      {"a.obj", "v 1 2\nf 1 1 1\n"},
      {"b.obj", "v 1 2 nan\nv 1 1 1\nv 0 0 0\nf 1 2 3\n"},
      {"c.obj", "v 1 2 inf\n"},
      {"d.obj", "v 1 2 3\nv 1 1 1\nv 0 0 0\nf 1 2 4\n"},
      {"e.obj", "v 1 2 3\nv 1 1 1\nv 0 0 0\nf 1 2 -4\n"},
      {"f.obj", "v 1 2 3\nv 1 1 1\nv 0 0 0\nf 0 1 2\n"},
      {"g.obj", std::string("\x7f\x45\x4c\x46\x02\x01\x00\xff garbage \n", 19)},
      {"h.obj", "v 1 2 3\nv 1 1 1\nf 1 2\n"},
      {"a.stl", "garbage"},
      {"b.stl", "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0\nendloop\n"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"},
      {"b.ply", "plx\n"},
      {"c.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"},
      {"d.ply", "ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_indices\n"
                "end_header\n-3 1 2 3\n"},
      {"e.ply", "ply\nformat ascii 1.0\nelement face 1\nproperty list int int vertex_indices\n"
                "end_header\n2000000000 1 2 3\n"}};
  for (const auto& [name, bytes] : bad)
    expectRefused(refusalOf([&, n = name, b = bytes] { readMesh(putFile(folder / n, b)); }),
                  Reason::Unreadable, name);
  expectRefused(refusalOf([&] { readMesh(putFile(folder / "z.obj", "v 1 2 3\n")); }),
                Reason::Unsupported, "no triangle");
  expectRefused(refusalOf([&] { readMesh(putFile(folder / "z.vtk", "v 1 2 3\n")); }),
                Reason::UnknownFormat, ".ply");
  expectRefused(refusalOf([&] { readMesh(folder / "none.obj"); }), Reason::NotFound);
  expectRefused(refusalOf([&] { readMesh(folder.path()); }), Reason::NotFound, "folder");
  expectRefused(refusalOf([&] { readMesh(putFile(folder / "0.obj", "")); }), Reason::Unreadable,
                "empty");
}

TEST(MeshFile, EveryCutOfAFileIsRefusedOrWhole)
{
  const TestFolder folder;
  const core::TriangleMesh box = boxOf(folder);
  for (const std::string end : {".stl", ".ply"})
  {
    writeMesh(folder / ("whole" + end), box);
    const std::string whole = fileBytes(folder / ("whole" + end));
    for (std::size_t length = 0; length < whole.size(); length += 7)
    {
      const auto cut = putFile(folder / ("cut" + end), whole.substr(0, length));
      EXPECT_TRUE(refusalOf([&] { readMesh(cut); }).thrown) << end << " " << length;
    }
  }
}

// Written by VTK's own writer.
TEST(MeshFile, ReadsVtpInEveryForm)
{
  const TestFolder folder;
  const core::TriangleMesh box = boxOf(folder);
  vtkNew<vtkPolyData> poly;
  vtkNew<vtkPoints> points;
  for (const auto& v : box.vertices)
    points->InsertNextPoint(v[0], v[1], v[2]);
  vtkNew<vtkCellArray> polys;
  for (const auto& t : box.triangles)
  {
    const vtkIdType corners[3] = {t[0], t[1], t[2]};
    polys->InsertNextCell(3, corners);
  }
  poly->SetPoints(points);
  poly->SetPolys(polys);
  for (const int mode : {vtkXMLWriter::Ascii, vtkXMLWriter::Binary, vtkXMLWriter::Appended})
    for (const int compressor :
         {vtkXMLWriter::NONE, vtkXMLWriter::ZLIB, vtkXMLWriter::LZ4, vtkXMLWriter::LZMA})
      for (const bool encodes : {true, false})
        for (const int order : {vtkXMLWriter::LittleEndian, vtkXMLWriter::BigEndian})
        {
          vtkNew<vtkXMLPolyDataWriter> writer;
          writer->SetInputData(poly);
          writer->SetFileName((folder / "box.vtp").c_str());
          writer->SetDataMode(mode);
          writer->SetCompressorType(compressor);
          writer->SetEncodeAppendedData(encodes);
          writer->SetByteOrder(order);
          writer->SetHeaderType(order == vtkXMLWriter::LittleEndian ? vtkXMLWriter::UInt64
                                                                    : vtkXMLWriter::UInt32);
          writer->SetBlockSize(48); // several blocks, the last one shorter
          ASSERT_EQ(writer->Write(), 1);
          const core::TriangleMesh read = readMesh(folder / "box.vtp");
          EXPECT_EQ(read.vertices, box.vertices) << mode << " " << compressor;
          EXPECT_EQ(read.triangles, box.triangles) << mode << " " << compressor;
        }
}

TEST(MeshFile, ReadsStripsOfVtpAndRefusesWhatItsCountsDoNotAllow)
{
  const TestFolder folder;
  const auto file = [&folder](const std::string& count, const std::string& connectivity,
                              const std::string& offsets)
  {
    return putFile(
        folder / "a.vtp",
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
        "byte_order=\"LittleEndian\"><PolyData><Piece NumberOfPoints=\"" +
            count +
            "\" NumberOfStrips=\"1\"><Points><DataArray type=\"Float32\" "
            "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 1 1 0</DataArray>"
            "</Points><Strips><DataArray type=\"Int64\" Name=\"connectivity\" "
            "format=\"ascii\">" +
            connectivity +
            "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + offsets +
            "</DataArray></Strips></Piece></PolyData></VTKFile>\n");
  };
  const core::TriangleMesh strip = readMesh(file("4", "0 1 2 3", "4"));
  ASSERT_EQ(strip.triangles.size(), 2U);
  for (const auto& t : strip.triangles) // both face the same side
  {
    const Eigen::Vector3f a = strip.vertices[t[0]];
    EXPECT_GT((strip.vertices[t[1]] - a).cross(strip.vertices[t[2]] - a)[2], 0.0F);
  }
  for (const auto& [count, corners, offsets] : {std::array<const char*, 3>{"4", "0 1 2 4", "4"},
                                                {"4", "0 1 2 -1", "4"},
                                                {"4", "0 1 2 3", "400"},
                                                {"4", "0 1 2 3", "-4"},
                                                {"999999999999", "0 1 2 3", "4"},
                                                {"99999999999999999999", "0 1 2 3", "4"}})
  {
    ::testing::internal::CaptureStderr();
    EXPECT_TRUE(refusalOf([&, path = file(count, corners, offsets)] { readMesh(path); }).thrown)
        << count << " " << corners << " " << offsets;
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  }
}

std::string base64(const std::string& bytes)
{
  constexpr const char* kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += 3)
  {
    std::uint32_t bits = 0;
    for (std::size_t n = 0; n < 3; ++n)
      bits = bits << 8 | (at + n < bytes.size() ? static_cast<unsigned char>(bytes[at + n]) : 0U);
    for (std::size_t n = 0; n < 4; ++n)
      text += at + n > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * n) & 63];
  }
  return text;
}

template <class T>
std::string bytesOf(const std::vector<T>& values)
{
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

// The headers of VTK's binary arrays state sizes that VTK allocates before it reads them.
TEST(MeshFile, RefusesHeadersOfVtpThatStateWhatTheFileDoesNotHold)
{
  const TestFolder folder;
  const auto piece = [](const std::string& points, const std::string& format)
  {
    return "<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points><DataArray type=\"Float32\" "
           "NumberOfComponents=\"3\" format=\"" +
           format + "\">" + points +
           "</DataArray></Points><Polys><DataArray type=\"UInt8\" Name=\"connectivity\" "
           "format=\"ascii\">0 1 2</DataArray><DataArray type=\"Int32\" Name=\"offsets\" "
           "format=\"ascii\"> 3 <InformationKey name=\"a\">7</InformationKey></DataArray></Polys>"
           "</Piece>";
  };
  const auto file = [&](const std::string& attributes, const std::string& body)
  {
    return putFile(folder / "a.vtp", "<?xml version=\"1.0\"?><VTKFile type=\"PolyData\" " +
                                         attributes + "><PolyData>" + body +
                                         "</PolyData></VTKFile>");
  };
  const std::string points = bytesOf<float>({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const auto binary = [&](const std::string& attributes, const std::string& header)
  { return file(attributes, piece(base64(header) + base64(points), "binary")); };

  // What is right is read: header and data encoded together and apart, and two pieces.
  EXPECT_EQ(readMesh(binary("", bytesOf<std::uint32_t>({36}))).triangles.size(), 1U);
  EXPECT_EQ(readMesh(binary("header_type=\"UInt64\"", bytesOf<std::uint64_t>({36}))).vertices[2],
            Eigen::Vector3f(0, 1, 0));
  EXPECT_EQ(readMesh(file("", piece(base64(bytesOf<std::uint32_t>({36}) + points), "binary")))
                .triangles.size(),
            1U);
  const std::string text = piece("0 0 0 1 0 0 0 1 0", "ascii");
  const core::TriangleMesh two = readMesh(file("", text + text));
  EXPECT_EQ(two.vertices.size(), 6U);
  EXPECT_EQ(two.triangles.at(1)[2], 5U) << "corners count from the piece's first point";

  const auto expect = [](const std::filesystem::path& path, const std::string& what)
  {
    const auto refusal = refusalOf([&path] { readMesh(path); });
    expectRefused(refusal, Reason::Unreadable, what);
    expectRefused(refusal, Reason::Unreadable, "a.vtp");
  };
  using Header = std::vector<std::uint32_t>;
  const std::string header64 = "header_type=\"UInt64\"";
  constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
  expect(binary("", bytesOf<std::uint32_t>({0xFFFFFFFF})), "array Points states 4294967295 bytes");
  expect(binary("", bytesOf<std::uint32_t>({24})), "array Points");
  expect(binary(header64, bytesOf<std::uint64_t>({kMost})), "array Points");
  expect(file("", piece(base64(bytesOf<std::uint32_t>({36})), "binary")), "array Points");
  expect(file("", piece("=", "binary")), "array Points");
  for (const char* name :
       {"vtkZLibDataCompressor", "vtkLZ4DataCompressor", "vtkLZMADataCompressor"})
  {
    const std::string packed = std::string("compressor=\"") + name + "\"";
    for (const Header& header :
         {Header{0x10000000, 1, 0, 8}, Header{0xFFFFFFFF, 0xFFFFFFFF, 1, 1},
          Header{1, 0xFFFFFFFF, 0, 8}, Header{0, 36, 0}, Header{2, 24, 12, 8},
          Header{1, 36, 36, 0xFFFFFFFF}, Header{1, 36, 36, 0}, Header{1, 36, 36, 20},
          Header{2, 18, 18, 8, 0x80000000}})
      expect(binary(packed, bytesOf(header)), "array Points");
    expect(
        binary(packed + " " + header64, bytesOf<std::uint64_t>({1ULL << 63, 2, 0, kMost, kMost})),
        "array Points");
    expect(binary(packed + " " + header64, bytesOf<std::uint64_t>({2, 18, 18, kMost, 2})),
           "array Points");
  }
  expect(binary("compressor=\"vtkOther\"", bytesOf(Header{1, 36, 36, 36})), "zlib, LZ4 and LZMA");
  expect(file("", piece("0 0 0 1 0 0 0 1", "ascii")), "8 of the 9 numbers");
  expect(file("", piece("0 0 0 1 0 0 0 1 0 1", "ascii")), "more than the 9 numbers");
  expect(file("", piece("0 0 0 1 0 0 0 1 x", "ascii")), "no number");
  expect(file("", piece("", "appended")), "array Points lies after the end");
  expect(putFile(folder / "a.vtp", "<!DOCTYPE a [<!ENTITY b \"b\">]><a>&b;</a>"), "document type");
  expect(putFile(folder / "a.vtp", "<VTKFile type=\"PolyData\"><PolyData>"), "well-formed");
}

TEST(MeshFile, RefusesToWriteWhatIsNoSurface)
{
  const TestFolder folder;
  core::TriangleMesh mesh = boxOf(folder);
  EXPECT_THROW(writeMesh(folder / "a.stl", {}), core::InvalidParameter);
  expectRefused(refusalOf([&] { writeMesh(folder / "a.vtp", mesh); }), Reason::UnknownFormat,
                ".stl");
  expectRefused(refusalOf([&] { writeMesh(folder / "none/a.stl", mesh); }), Reason::Unwritable);
  mesh.vertices[0][1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(writeMesh(folder / "a.stl", mesh), core::InvalidParameter);
  EXPECT_EQ(folder.fileCount(), 1U); // the box itself
}

} // namespace
} // namespace petrous::imaging
