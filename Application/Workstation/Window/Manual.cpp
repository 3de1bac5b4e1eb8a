#include "Manual.h"

#include <QDir>
#include <QFileInfo>
#include <QObject>

namespace petrous::workstation
{

QString manualFile(const QString& programs)
{
  for (const char* place :
       {"../share/doc/petrous/manual/index.html", "../../manual/html/index.html"})
  {
    const QString file = QDir::cleanPath(QDir(programs).filePath(place));
    if (QFileInfo(file).isFile())
      return file;
  }
  return {};
}

QString openManual(const QString& programs, const std::function<bool(const QUrl&)>& open,
                   const QString& page)
{
  const QString first = manualFile(programs);
  const QString file = first.isEmpty() ? first : QFileInfo(first).dir().filePath(page);
  if (file.isEmpty())
    return QObject::tr("The manual is not installed here. The package petrous has it; in a build "
                       "tree 'ninja manual' makes it (needs python3-sphinx and "
                       "python3-myst-parser)");
  if (!open(QUrl::fromLocalFile(file)))
    return QObject::tr("No browser could be started. The manual is %1").arg(file);
  return {};
}

} // namespace petrous::workstation
