#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <QAbstractTableModel>
#include <QPixmap>
#include <QTimer>

#include "BackgroundWork.h"
#include "petrous/Library/Library.h"

namespace petrous::workstation
{

/// The cases of a library as a table, a line each. Thumbnails are read in a separate thread, of the
/// cases that are seen, the last seen first.
class CasesModel : public QAbstractTableModel
{
  Q_OBJECT
public:
  enum Column
  {
    Name,
    Changed,
    Diagnosis,
    Side,
    Planned,
    Tags,
    Structures,
    Strokes,
    Removed,
    Voxels,
    ColumnCount
  };

  explicit CasesModel(QObject* parent = nullptr);

  /// That of the cases; called in the window's thread.
  std::function<library::Library()> library;
  /// Hears which cases are seen.
  std::function<void(const library::CaseSummary&)> seen;

  /// The cases found by a search; `open` is the name of the open one, or empty.
  void setCases(std::vector<library::CaseSummary> cases, const std::string& open);

  /// Of a valid row.
  const library::CaseSummary& at(int row) const { return m_cases[static_cast<std::size_t>(row)]; }
  int rowOf(const std::string& name) const; ///< -1: there is none
  void forgetPictures();                    ///< they are read again
  void pictureDrawn(const std::string& id); ///< of that case: it is read again
  void setPictureSize(const QSize& size) { m_pictureSize = size; }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;
  void sort(int column, Qt::SortOrder order) override;

private:
  struct Picture
  {
    QPixmap pixmap;
    bool isOld = false; ///< shown until it is read again
  };
  struct Read
  {
    std::string id;
    QImage image; ///< null: it cannot be read
  };
  void sortCases();
  QVariant picture(const library::CaseSummary& one) const;
  void want(const library::CaseSummary& one) const;
  void read();
  void take(const std::vector<Read>& pictures);
  void pictureChanged(const std::string& id);

  std::vector<library::CaseSummary> m_cases;
  std::set<std::string> m_newer; ///< library::isOfNewerVersion
  std::string m_open;
  std::map<std::string, Picture> m_pictures;          ///< by id of the case; what was looked at
  mutable std::vector<library::CaseSummary> m_wanted; ///< to be read, the last one first
  std::set<std::string> m_reading;                    ///< ids; not of those that changed meanwhile
  QSize m_pictureSize;
  int m_column = Changed;
  Qt::SortOrder m_order = Qt::DescendingOrder;
  mutable QTimer m_soon; ///< what is painted at once is read at once
  BackgroundWork m_work;
};

constexpr QSize kCasePicture{64, 48}; ///< px, of the thumbnails in the list

/// The side and the planned date, as far as they are known, in a line.
QString operationText(const library::CaseSummary& one);

/// A time of the library (UTC, ISO 8601) for the user: local, to the minute.
QString localTime(const std::string& utc);

} // namespace petrous::workstation
