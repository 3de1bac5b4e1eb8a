#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <QAbstractItemModel>

#include "BackgroundWork.h"
#include "petrous/Presenters/StructureList.h"
#include "petrous/Volume/MeshMeasure.h"

namespace petrous::appearance
{
struct StructureProperty;
}

namespace petrous::workstation
{

/// Bone, soft tissue, structures and meshes of the open case: bone and soft tissue first, the
/// others by kind in rows that fold; check boxes and numbers modify the case. The row of a kind
/// changes all of them.
class StructuresModel : public QAbstractItemModel
{
  Q_OBJECT
public:
  enum Column
  {
    Name,
    VolumeColumn, ///< mm^3, "open" of an open mesh, "…" while it is measured; empty: not known
    Burr, ///< distance to the burr or instrument that is in use, mm, and how well it is known
    FirstProperty ///< and those after it: kStructureProperties with a column
  };

  /// The column of the property with this key; -1 if it has none.
  static int columnOf(const std::string& key);
  /// Why the property changes nothing of a part with this appearance, as a lumen is not felt
  /// whatever its mark says; empty if it does.
  static QString idleText(const appearance::StructureAppearance& look,
                          const appearance::StructureProperty& property);

  explicit StructuresModel(presenters::WorkstationModel& model, QObject* parent = nullptr);

  /// How many label structures and meshes there are, and how many are shown.
  QString countText() const;
  /// Of the row, as WorkstationModel::lookOf; empty of a kind.
  std::string partAt(const QModelIndex& index) const;
  std::string nameAt(const QModelIndex& index) const; ///< of a structure or mesh; else empty
  QModelIndex rowOf(const std::string& part) const;   ///< invalid if there is none
  appearance::StructureAppearance lookAt(const QModelIndex& index) const;
  /// What a search finds: its name as it is shown, its preset and its kind, without diacritics and
  /// case (`folded`).
  QString searchText(const QModelIndex& index) const;
  static QString folded(const QString& text);
  /// How many of a kind a search has found, which then stands beside its name; nullopt: none is
  /// under way.
  void setFound(const QModelIndex& kind, std::optional<std::size_t> found);
  QString titleOf(const std::string& part) const; ///< as it is shown

  void caseChanged();
  void appearanceChanged();
  bool needsRebuild(); ///< the rows are others; `appearanceChanged` would reset them
  void setNear(std::vector<presenters::NearbyStructure> structures); ///< empty: no burr is in use

  QModelIndex index(int row, int column, const QModelIndex& parent = {}) const override;
  QModelIndex parent(const QModelIndex& index) const override;
  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  Qt::ItemFlags flags(const QModelIndex& index) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;

private:
  struct Row
  {
    presenters::StructureRow row;
    bool isBeingMeasured = false;
    std::size_t openEdges = 0; ///< of a mesh that is not closed and so has no volume
    double volume = 0.0;       ///< mm^3; 0: not known
    QString near = {};
    std::string notDrawn = {}; ///< why soft tissue that is shown is not drawn
  };
  /// Rows of one kind, those from `first` on.
  struct Kind
  {
    presenters::StructureKind kind;
    std::size_t first = 0, count = 0;
    std::optional<std::size_t> found = {}; ///< of a search
  };
  struct Measured
  {
    std::shared_ptr<const core::TriangleMesh> mesh; ///< nullptr: it cannot be read
    volume::MeshMeasure measure;
  };
  using Measures = std::map<std::string, Measured>; // by the mesh's name
  std::vector<Row> rows();
  bool isOthers(const std::vector<Row>& next) const;
  const Row* at(const QModelIndex& index) const; // nullptr: a kind, or nothing
  const Kind* kindAt(const QModelIndex& index) const;
  const Measured* measuredOf(const scene::MeshPart& part) const; // nullptr: not yet
  void measureMeshes();
  QVariant kindData(const Kind& kind, int column, int role) const;
  /// Of the kind, those of which the property changes something.
  std::vector<const Row*> changedBy(const Kind& kind,
                                    const appearance::StructureProperty& property) const;
  QVariant propertyData(const Row& row, const appearance::StructureProperty& property,
                        int role) const;
  QString primary() const; ///< image: "CT" or "MR"
  QString title(const presenters::StructureRow& row) const;
  QString untouchableText(const std::string& mesh) const;

  presenters::WorkstationModel& m_model;
  std::vector<Row> m_rows;
  std::vector<Kind>
      m_kinds; // of structures and meshes, as the model has them below bone and tissue
  Measures m_measured;
  std::uint64_t m_measuredOf = 0; // WorkstationModel::shownAs
  BackgroundWork m_work;          // measures large meshes in seconds
};

} // namespace petrous::workstation
