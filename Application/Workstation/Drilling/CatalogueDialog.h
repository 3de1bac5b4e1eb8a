#pragma once

#include <functional>

#include <QDialog>

#include "petrous/Presenters/CatalogueEditor.h"

class QLabel;
class QPushButton;
class QTableWidget;

namespace petrous::workstation
{

/// The library's materials and burrs as tables, with units and the source of each number.
class CatalogueDialog : public QDialog
{
  Q_OBJECT
public:
  /// `isUsed`: whether a structure of the open case is of that material.
  CatalogueDialog(presenters::CatalogueEditor editor,
                  std::function<bool(const std::string&)> isUsed, QWidget* parent = nullptr);

signals:
  void saved();

private:
  void fill();
  void fillMaterial(int row);
  void fillBurr(int row);
  void enableRemove();
  /// `where`: row and column of the table, to the user; empty: of no cell.
  void enter(const std::function<void()>& change, const QString& where = {});
  void checkUnused(const std::string& material) const;
  void materialEntered(int row, int column);
  void burrEntered(int row, int column);
  void addRow(QTableWidget& table, int nameColumn,
              std::size_t (presenters::CatalogueEditor::*add)(std::size_t like));
  void addMaterial();
  void addBurr();
  void removeMaterial();
  void removeBurr();
  void setBuiltIn();
  void save();

  presenters::CatalogueEditor m_editor;
  std::function<bool(const std::string&)> m_isUsed;
  QTableWidget* m_materials;
  QTableWidget* m_burrs;
  QLabel* m_bone;
  QLabel* m_lost;
  QLabel* m_fault;
  QPushButton* m_removeMaterial;
  QPushButton* m_removeBurr;
  QPushButton* m_save;
  bool m_filling = false;
};

} // namespace petrous::workstation
