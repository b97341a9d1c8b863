"""Why a gait forms: modes of compliant legs under a rigid trunk, and what the feedback makes of
them.
"""
