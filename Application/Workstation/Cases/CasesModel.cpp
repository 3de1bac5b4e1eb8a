#include "CasesModel.h"

#include <algorithm>
#include <tuple>

#include <QApplication>
#include <QDateTime>
#include <QFont>
#include <QPalette>

#include "DescriptionDialog.h"
#include "Theme.h"
#include "WindowTexts.h"
#include "petrous/Library/NewerVersion.h"

namespace petrous::workstation
{

namespace
{
constexpr std::size_t kReadAtOnce = 8;
constexpr std::size_t kMostWanted = 64; // what was scrolled past is asked for again when it is seen
} // namespace

QString localTime(const std::string& utc)
{
  return QDateTime::fromString(words(utc), Qt::ISODate)
      .toLocalTime()
      .toString(dateFormat() + " HH:mm");
}

CasesModel::CasesModel(QObject* parent)
  : QAbstractTableModel(parent)
  , m_pictureSize(kCasePicture)
{
  m_soon.setSingleShot(true);
  connect(&m_soon, &QTimer::timeout, this, &CasesModel::read);
  const auto goOn = [this] { take({}); };
  connect(&m_work, &BackgroundWork::failed, this, goOn);
  connect(&m_work, &BackgroundWork::cancelled, this, goOn);
}

QString operationText(const library::CaseSummary& one)
{
  const QString side = sideText(one.description.side);
  const QString date = dateText(one.description.date);
  const QString planned = date.isEmpty() ? date : CasesModel::tr("planned %1").arg(date);
  return side.isEmpty() || planned.isEmpty() ? side + planned : side + ", " + planned;
}

void CasesModel::setCases(std::vector<library::CaseSummary> cases, const std::string& open)
{
  beginResetModel();
  m_cases = std::move(cases);
  m_open = open;
  m_newer.clear();
  for (const library::CaseSummary& one : m_cases)
    if (one.damaged && library && library::isOfNewerVersion(library().folder(), one.name))
      m_newer.insert(one.name);
  sortCases();
  endResetModel();
}

int CasesModel::rowOf(const std::string& name) const
{
  const auto found = std::find_if(m_cases.begin(), m_cases.end(),
                                  [&](const auto& one) { return one.name == name; });
  return found == m_cases.end() ? -1 : static_cast<int>(found - m_cases.begin());
}

void CasesModel::forgetPictures()
{
  for (auto& [id, picture] : m_pictures)
    picture.isOld = true;
  m_reading.clear();
  if (!m_cases.empty())
    emit dataChanged(index(0, Name), index(rowCount() - 1, Name), {Qt::DecorationRole});
}

void CasesModel::pictureDrawn(const std::string& id)
{
  for (library::CaseSummary& one : m_cases)
    if (one.id == id)
      one.hasThumbnail = true;
  if (const auto known = m_pictures.find(id); known != m_pictures.end())
    known->second.isOld = true;
  m_reading.erase(id);
  pictureChanged(id);
}

void CasesModel::pictureChanged(const std::string& id)
{
  for (std::size_t row = 0; row < m_cases.size(); ++row)
    if (m_cases[row].id == id)
    {
      const QModelIndex changed = index(static_cast<int>(row), Name);
      emit dataChanged(changed, changed, {Qt::DecorationRole});
    }
}

// Of the same size for all, so that names stand below each other.
QVariant CasesModel::picture(const library::CaseSummary& one) const
{
  if (seen)
    seen(one);
  const auto known = m_pictures.find(one.id);
  const bool isKnown = one.hasThumbnail && known != m_pictures.end();
  if (one.hasThumbnail && (!isKnown || known->second.isOld))
    want(one);
  if (isKnown && !known->second.pixmap.isNull())
    return known->second.pixmap;
  QPixmap blank(m_pictureSize);
  blank.fill(Qt::transparent);
  return blank;
}

void CasesModel::want(const library::CaseSummary& one) const
{
  if (!library || m_reading.count(one.id) > 0)
    return;
  m_wanted.erase(std::remove_if(m_wanted.begin(), m_wanted.end(),
                                [&one](const auto& other) { return other.id == one.id; }),
                 m_wanted.end());
  if (m_wanted.size() == kMostWanted)
    m_wanted.erase(m_wanted.begin());
  m_wanted.push_back(one);
  m_soon.start();
}

void CasesModel::read()
{
  if (m_work.busy() || m_wanted.empty())
    return;
  std::vector<library::CaseSummary> cases;
  for (; cases.size() < kReadAtOnce && !m_wanted.empty(); m_wanted.pop_back())
  {
    m_reading.insert(m_wanted.back().id);
    cases.push_back(std::move(m_wanted.back()));
  }
  m_work.start(
      [this, cases = std::move(cases), library = library(),
       size = m_pictureSize](const core::Progress& progress) -> BackgroundWork::Reply
      {
        std::vector<Read> pictures;
        for (const library::CaseSummary& one : cases)
        {
          progress.check("reading pictures");
          const auto png = library.thumbnail(one);
          Read read{one.id, {}};
          if (read.image.loadFromData(png.data(), static_cast<int>(png.size()), "PNG"))
            read.image = read.image.scaled(size, Qt::KeepAspectRatio, Qt::SmoothTransformation);
          pictures.push_back(std::move(read));
        }
        return [this, pictures = std::move(pictures)] { take(pictures); };
      });
}

void CasesModel::take(const std::vector<Read>& pictures)
{
  for (const Read& one : pictures)
    m_pictures[one.id] = {QPixmap::fromImage(one.image), m_reading.count(one.id) == 0};
  m_reading.clear();
  for (const Read& one : pictures)
    pictureChanged(one.id);
  read();
}

int CasesModel::rowCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : static_cast<int>(m_cases.size());
}

int CasesModel::columnCount(const QModelIndex& parent) const
{
  return parent.isValid() ? 0 : ColumnCount;
}

namespace
{

QString textOf(const library::CaseSummary& one, int column, bool isNewer = false)
{
  if (column == CasesModel::Name)
    return caseName(one.name);
  if (one.damaged)
    return column != CasesModel::Structures ? QString()
           : isNewer                        ? CasesModel::tr("newer version")
                                            : CasesModel::tr("damaged");
  switch (column)
  {
  case CasesModel::Changed:
    return localTime(one.modified);
  case CasesModel::Diagnosis:
    return words(one.description.diagnosis);
  case CasesModel::Side:
    return sideText(one.description.side);
  case CasesModel::Planned:
    return dateText(one.description.date);
  case CasesModel::Tags:
    return listed(one.description.tags);
  case CasesModel::Structures:
    return QString::number(one.structures);
  case CasesModel::Strokes:
    return QString::number(one.strokes);
  case CasesModel::Removed:
    return numberText(one.removed, 1);
  case CasesModel::Voxels:
    return QString("%1 × %2 × %3").arg(one.dims[0]).arg(one.dims[1]).arg(one.dims[2]);
  default:
    return {};
  }
}

QString tipOf(const library::CaseSummary& one, bool open, bool isNewer)
{
  if (isNewer)
    return CasesModel::tr("%1: was written by a newer version of Petrous; open it with that one. "
                          "Here it is left alone.")
        .arg(caseName(one.name));
  if (one.damaged)
    return CasesModel::tr("%1: its file cannot be read. It can still be renamed and deleted; "
                          "Library > Verify says what is wrong.")
        .arg(caseName(one.name));
  QStringList lines{caseName(one.name) + (open ? CasesModel::tr(" (open)") : QString())};
  lines += CasesModel::tr("changed %1").arg(localTime(one.modified));
  lines += CasesModel::tr("%1 voxels, %2 structures")
               .arg(textOf(one, CasesModel::Voxels))
               .arg(one.structures);
  const QString removed = numberText(one.removed, 1);
  lines += one.strokes == 1
               ? CasesModel::tr("1 stroke, %1 mm³ removed").arg(removed)
               : CasesModel::tr("%1 strokes, %2 mm³ removed").arg(one.strokes).arg(removed);
  const QString what = words(one.description.diagnosis);
  const QString how = words(one.description.procedure);
  if (!what.isEmpty() || !how.isEmpty())
    lines += what.isEmpty() ? how : how.isEmpty() ? what : what + ", " + how;
  if (one.hasNote)
    lines += CasesModel::tr("with a note");
  return lines.join('\n');
}

} // namespace

QVariant CasesModel::data(const QModelIndex& index, int role) const
{
  if (!index.isValid())
    return {};
  const library::CaseSummary& one = at(index.row());
  const bool open = one.name == m_open;
  const bool isNewer = m_newer.count(one.name) > 0;
  switch (role)
  {
  case Qt::DisplayRole:
    return textOf(one, index.column(), isNewer);
  case Qt::DecorationRole:
    return index.column() == Name ? picture(one) : QVariant();
  case Qt::ToolTipRole:
    return tipOf(one, open, isNewer);
  case Qt::AccessibleTextRole:
  {
    if (index.column() != Name)
      return {};
    QStringList all{caseName(one.name), operationText(one), listed(one.description.tags)};
    all.removeAll(QString());
    return all.join(", ");
  }
  case Qt::TextAlignmentRole:
    return index.column() >= Structures ? int(Qt::AlignRight | Qt::AlignVCenter)
                                        : int(Qt::AlignLeft | Qt::AlignVCenter);
  case Qt::ForegroundRole:
    return one.damaged
               ? QVariant(QApplication::palette().brush(QPalette::Disabled, QPalette::WindowText))
               : QVariant();
  case Qt::FontRole:
  {
    QFont font;
    font.setBold(open);
    return open ? QVariant(font) : QVariant();
  }
  default:
    return {};
  }
}

QVariant CasesModel::headerData(int section, Qt::Orientation orientation, int role) const
{
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole)
    return QAbstractTableModel::headerData(section, orientation, role);
  switch (section)
  {
  case Name:
    return tr("Case");
  case Changed:
    return tr("Changed");
  case Diagnosis:
    return tr("Diagnosis");
  case Side:
    return tr("Side");
  case Planned:
    return tr("Planned");
  case Tags:
    return tr("Tags");
  case Structures:
    return tr("Structures");
  case Strokes:
    return tr("Strokes");
  case Removed:
    return tr("Removed mm³");
  case Voxels:
    return tr("Voxels");
  default:
    return {};
  }
}

void CasesModel::sort(int column, Qt::SortOrder order)
{
  beginResetModel();
  m_column = column;
  m_order = order;
  sortCases();
  endResetModel();
}

// Equal ones by name.
void CasesModel::sortCases()
{
  const auto count = [](const library::CaseSummary& one)
  { return static_cast<double>(one.dims[0]) * one.dims[1] * one.dims[2]; };
  const auto isLess = [&](const library::CaseSummary& a, const library::CaseSummary& b)
  {
    switch (m_column)
    {
    case Diagnosis:
    case Side:
    case Tags:
      return textOf(a, m_column).localeAwareCompare(textOf(b, m_column)) < 0;
    case Planned:
      return a.description.date < b.description.date;
    case Changed:
      return a.modified < b.modified;
    case Structures:
      return a.structures < b.structures;
    case Strokes:
      return a.strokes < b.strokes;
    case Removed:
      return a.removed < b.removed;
    case Voxels:
      return count(a) < count(b);
    default:
      return a.name < b.name;
    }
  };
  std::sort(m_cases.begin(), m_cases.end(),
            [](const auto& a, const auto& b) { return a.name < b.name; });
  std::stable_sort(m_cases.begin(), m_cases.end(),
                   [&](const auto& a, const auto& b)
                   { return m_order == Qt::AscendingOrder ? isLess(a, b) : isLess(b, a); });
}

} // namespace petrous::workstation
