#include "MeshReaders.h"

#include <algorithm>
#include <charconv>
#include <new>
#include <string>

#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

namespace petrous::imaging
{

namespace
{

/// VTK prints what it finds wrong, and allocates what a file states before it reads it.
class Quiet
{
public:
  Quiet()
    : m_before(vtkObject::GetGlobalWarningDisplay())
  {
    vtkObject::SetGlobalWarningDisplay(0);
  }
  ~Quiet() { vtkObject::SetGlobalWarningDisplay(m_before); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

private:
  int m_before;
};

/// Deflate packs at most 1032 bytes in one (RFC 1951).
constexpr std::uint64_t kMostPerByte = 1032;

/// Every number of points or cells that the text states is one that the file can hold.
void checkCounts(std::string_view bytes, const MeshBuilder& builder)
{
  constexpr std::string_view kNumber = "NumberOf";
  for (std::size_t at = bytes.find(kNumber); at != bytes.npos;
       at = bytes.find(kNumber, at + kNumber.size()))
  {
    const std::size_t quote = bytes.find_first_of("\"'>", at);
    if (quote == bytes.npos || bytes[quote] == '>')
      continue;
    std::uint64_t count = 0;
    const auto [end, fault] =
        std::from_chars(bytes.data() + quote + 1, bytes.data() + bytes.size(), count);
    if (fault == std::errc::result_out_of_range || count > kMostPerByte * bytes.size())
      builder.failUnreadable("it states more points or faces than it can hold");
  }
}

/// Calls visit(corners) for each cell; VTK does not check where a cell begins and ends.
template <class Visit>
void forEachCell(vtkCellArray* cells, const MeshBuilder& builder, const Visit& visit)
{
  if (!cells || cells->GetNumberOfCells() == 0)
    return;
  vtkDataArray* offsets = cells->GetOffsetsArray();
  vtkDataArray* corners = cells->GetConnectivityArray();
  if (!offsets || !corners)
    builder.failUnreadable("a face has no corners");
  std::vector<std::int64_t> cell;
  for (vtkIdType n = 0; n + 1 < offsets->GetNumberOfTuples(); ++n)
  {
    const auto first = static_cast<std::int64_t>(offsets->GetComponent(n, 0));
    const auto last = static_cast<std::int64_t>(offsets->GetComponent(n + 1, 0));
    if (first < 0 || last < first || last > corners->GetNumberOfTuples())
      builder.failUnreadable("a face has corners that are not there");
    cell.clear();
    for (std::int64_t corner = first; corner < last; ++corner)
      cell.push_back(static_cast<std::int64_t>(corners->GetComponent(corner, 0)));
    visit(cell);
  }
}

} // namespace

core::TriangleMesh parseVtp(const std::filesystem::path& path, std::string_view bytes)
{
  MeshBuilder builder(path);
  checkCounts(bytes, builder);
  const Quiet quiet;
  vtkNew<vtkXMLPolyDataReader> reader;
  try
  {
    reader->ReadFromInputStringOn();
    reader->SetInputString(std::string(bytes));
    reader->Update();
  }
  catch (const std::bad_alloc&)
  {
    builder.failUnreadable("it states more than the memory can hold");
  }
  vtkPolyData* poly = reader->GetOutput();
  if (reader->GetErrorCode() != 0 || !poly || !poly->GetPoints())
    builder.failUnreadable("it is no surface of the VTK XML format");
  vtkPoints* points = poly->GetPoints();
  const vtkIdType count = points->GetNumberOfPoints();
  builder.reserve(static_cast<std::size_t>(count),
                  static_cast<std::size_t>(std::max<vtkIdType>(poly->GetNumberOfPolys(), 0)));
  for (vtkIdType n = 0; n < count; ++n)
  {
    double p[3];
    points->GetPoint(n, p);
    builder.addVertex(static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]));
  }
  forEachCell(poly->GetPolys(), builder,
              [&builder](const std::vector<std::int64_t>& cell) { builder.addPolygon(cell); });
  forEachCell(poly->GetStrips(), builder,
              [&builder](const std::vector<std::int64_t>& cell)
              {
                if (cell.size() < 3)
                  builder.failUnreadable("a strip has fewer than three corners");
                for (std::size_t n = 2; n < cell.size(); ++n) // every other one is turned
                  builder.addPolygon(n % 2 == 0 ? std::vector{cell[n - 2], cell[n - 1], cell[n]}
                                                : std::vector{cell[n - 1], cell[n - 2], cell[n]});
              });
  return builder.take();
}

} // namespace petrous::imaging
