#pragma once

#include <filesystem>

#include <QDialog>

#include "BackgroundWork.h"
#include "petrous/Network/NodeList.h"

class QCheckBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;
class QSpinBox;

namespace petrous::workstation
{

class PathRow;

/// The DICOM nodes of a library (`petrous nodes`): listed, added, changed, called and removed.
class NodesDialog : public QDialog
{
  Q_OBJECT
public:
  explicit NodesDialog(std::filesystem::path library, QWidget* parent = nullptr);
  ~NodesDialog() override;

  std::string chosen() const; ///< the selected node; empty: none

private:
  void layOut();
  void fill(const std::string& current);
  void show(const network::Node& node);
  network::Node typed() const;
  void check();
  void keep();
  void test();
  void remove();
  void say(const QString& text);
  void attempt(const std::function<void()>& change);

  std::filesystem::path m_library;
  QListWidget* m_list;
  QLineEdit* m_name;
  QLineEdit* m_host;
  QSpinBox* m_port;
  QLineEdit* m_title;
  QLineEdit* m_own;
  QSpinBox* m_movePort;
  QLineEdit* m_moveHost;
  QCheckBox* m_tls;
  QLineEdit* m_certifiedName;
  PathRow* m_authority;
  PathRow* m_certificate;
  PathRow* m_key;
  QLabel* m_outcome;
  QPushButton* m_keep;
  QPushButton* m_test;
  QPushButton* m_remove;
  BackgroundWork m_work;
};

} // namespace petrous::workstation
