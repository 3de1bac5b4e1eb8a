#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <QAbstractTableModel>

#include "BackgroundWork.h"
#include "petrous/Presenters/WorkstationModel.h"
#include "petrous/Volume/MeshMeasure.h"

namespace petrous::appearance
{
struct StructureProperty;
}

namespace petrous::workstation
{

/// The structures and meshes of the open case as rows; check boxes and numbers modify the case.
class StructuresModel : public QAbstractTableModel
{
  Q_OBJECT
public:
  enum Column
  {
    Name,
    VolumeColumn, ///< mm^3, "open" of an open mesh, "…" while it is measured; empty: not known
    FirstProperty ///< and those after it: kStructureProperties with a column
  };

  /// The column of the property with this key; -1 if it has none.
  static int columnOf(const std::string& key);

  explicit StructuresModel(presenters::WorkstationModel& model, QObject* parent = nullptr);

  /// How many label structures and meshes there are, and how many are shown.
  QString countText() const;
  std::string nameAt(const QModelIndex& index) const; ///< of the row; empty if there is none
  QModelIndex rowOf(const std::string& name) const;   ///< invalid if there is none
  appearance::StructureAppearance lookAt(const QModelIndex& index) const;

  void caseChanged();
  void appearanceChanged();

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;

private:
  struct Row
  {
    std::string name;
    double volume = 0.0; ///< mm^3; 0: not known
    bool isMesh = false;
    bool isBeingMeasured = false;
    std::size_t openEdges = 0; ///< of a mesh that is not closed and so has no volume
    appearance::StructureAppearance look;
    std::string missing; ///< why it cannot be placed on the CT (scene::Placement); usually empty
  };
  struct Measured
  {
    std::shared_ptr<const core::TriangleMesh> mesh; ///< nullptr: it cannot be read
    volume::MeshMeasure measure;
  };
  using Measures = std::map<std::string, Measured>; // by the mesh's name
  std::vector<Row> rows();
  const Measured* measuredOf(const scene::MeshPart& part) const; // nullptr: not yet
  void measureMeshes();
  QVariant propertyData(const Row& row, const appearance::StructureProperty& property,
                        int role) const;
  QString primary() const; ///< image: "CT" or "MR"
  QString untouchableText(const std::string& mesh) const;

  presenters::WorkstationModel& m_model;
  std::vector<Row> m_rows;
  Measures m_measured;
  std::uint64_t m_measuredOf = 0; // WorkstationModel::shownAs
  BackgroundWork m_work;          // measures large meshes in seconds
};

} // namespace petrous::workstation
