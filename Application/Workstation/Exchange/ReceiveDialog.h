#pragma once

#include <vector>

#include <QDialog>

#include "BackgroundWork.h"
#include "petrous/Network/NodeList.h"
#include "petrous/Presenters/CaseTransfer.h"

class QComboBox;
class QDateEdit;
class QCheckBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QTreeWidget;
class QTreeWidgetItem;

namespace petrous::workstation
{

/// Looks for a case or a patient at a node and lets the user choose a study and its series. What it
/// shows may identify patients, and is not kept.
class ReceiveDialog : public QDialog
{
  Q_OBJECT
public:
  /// What is to be received.
  struct Choice
  {
    network::Node node;
    std::string study;
    std::vector<std::string> series; ///< of images; none if it is a scene
    bool scene = false;              ///< the case that was sent with its scene
  };

  ReceiveDialog(const std::vector<network::Node>& nodes, const library::Library& library,
                QWidget* parent = nullptr);
  ~ReceiveDialog() override;

  Choice choice() const;

private:
  presenters::StudySearch wanted() const;
  network::Node node() const;
  void search();
  void listSeries(QTreeWidgetItem* study);
  void show(const presenters::FoundStudies& found);
  void update();
  void begin(const QString& text, BackgroundWork::Work work);
  void say(const QString& text);

  std::vector<network::Node> m_nodes;
  library::Library m_library;
  QComboBox* m_node;
  QLineEdit* m_case;
  QLineEdit* m_id;
  QLineEdit* m_name;
  QCheckBox* m_dated;
  QDateEdit* m_from;
  QDateEdit* m_to;
  QComboBox* m_modality;
  QTreeWidget* m_found;
  QLabel* m_outcome;
  QPushButton* m_search;
  QPushButton* m_receive;
  BackgroundWork m_work;
};

} // namespace petrous::workstation
