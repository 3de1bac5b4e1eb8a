#pragma once

#include <vector>

#include <QDialog>

#include "FaceCheck.h"
#include "petrous/Network/NodeList.h"
#include "petrous/Presenters/CaseTransfer.h"

class QCheckBox;
class QComboBox;
class QPlainTextEdit;
class QPushButton;

namespace petrous::workstation
{

/// What of a case goes to which node, with what leaves the house and what stays.
class SendDialog : public QDialog
{
  Q_OBJECT
public:
  /// `nodes`: at least one. The case must outlive the dialog.
  SendDialog(const scene::Case& value, const library::Library& library, const FaceCheck& faces,
             const std::vector<network::Node>& nodes, QWidget* parent = nullptr);

  presenters::SendParts parts() const;
  network::Node node() const;
  /// That faces go along unmasked, a sentence each; empty: none does, as far as is known.
  QStringList facesLeft() const;

private:
  void update();
  /// Images with a face among those that are sent.
  std::vector<scene::ImageWithFace> facesSent(const presenters::SendParts& what) const;

  const scene::Case& m_value;
  library::Library m_library;
  std::vector<network::Node> m_nodes;
  QComboBox* m_node;
  QCheckBox* m_ct;
  QCheckBox* m_mr;
  QCheckBox* m_labels;
  QCheckBox* m_scene;
  QCheckBox* m_note;
  QCheckBox* m_videos;
  QCheckBox* m_documents;
  QCheckBox* m_maskFace;
  FaceCheck m_faces;
  QPlainTextEdit* m_report;
  QPushButton* m_send;
};

} // namespace petrous::workstation
