#pragma once

#include <filesystem>

#include <QWidget>

class QLineEdit;

namespace petrous::workstation
{

/// A path that is typed or chosen with a dialog.
class PathRow : public QWidget
{
  Q_OBJECT
public:
  enum class Kind
  {
    File,    ///< that exists
    NewFile, ///< that may exist
    Folder   ///< that may exist
  };
  /// `name` is the object name of the line; `title` that of the dialog.
  PathRow(const char* name, Kind kind, const QString& title, QWidget* parent = nullptr);

  std::filesystem::path path() const; ///< empty: none
  QString text() const;
  void setText(const QString& text);
  void setPlaceholder(const QString& text);

signals:
  void changed();

private:
  void browse();

  Kind m_kind;
  QString m_title;
  QLineEdit* m_line;
};

} // namespace petrous::workstation
